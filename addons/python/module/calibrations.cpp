#include <filesystem>
#include <optional>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "addons/python/module/bindings.hpp"
#include "addons/python/module/models.hpp"
#include "addons/python/module/page_text.hpp"
#include "addons/python/module/signal_check.hpp"
#include "spoolflow/apps/work/readable_model.hpp"
#include "spoolflow/apps/work/recalibration.hpp"
#include "spoolflow/calibration/calibrate.hpp"
#include "spoolflow/calibration/environment.hpp"
#include "spoolflow/calibration/type/calibrate_unit.hpp"
#include "spoolflow/calibration/type/several_units.hpp"
#include "spoolflow/calibration/type/type_model.hpp"
#include "spoolflow/monitor/adaptation.hpp"
#include "spoolflow/recording/environment.hpp"
#include "spoolflow/report/validation/validation_report.hpp"

namespace spoolflow::python {
namespace {

namespace py = pybind11;
using Path = std::filesystem::path;

SharedModel kept(const model::Model& model) {
  return std::make_shared<KeptModel>(apps::readable_text(model, "the model"), "the model");
}

recording::OutsideFiles outside(bool allowed) {
  return allowed ? recording::OutsideFiles::allowed : recording::OutsideFiles::refused;
}

std::vector<std::string> resampled_in(const model::Model& model) {
  std::vector<std::string> out;
  for (const model::InputFile& input : model.provenance.inputs) {
    if (!input.resampled.empty()) out.push_back(input.file + ": " + input.resampled);
  }
  return out;
}

struct Made {
  SharedModel model;
  std::optional<std::string> page{};
  std::vector<std::string> notes{};
  [[nodiscard]] py::tuple tuple() const { return py::make_tuple(model, page, notes); }
};

/// Of one campaign; `as_type` makes it the model of every unit of its type, and several campaigns are compared for it.
py::tuple calibrate(const std::vector<Path>& files, bool allow_outside, bool despite_doubts, bool as_type,
                    const PageUnits& units, const py::object& progress) {
  return at_work([&](SignalCheck& check) {
           std::vector<recording::Campaign> campaigns;
           for (const Path& file : files) campaigns.push_back(recording::read_campaign(file, outside(allow_outside)));
           std::vector<model::Model> models;
           Made out;
           for (const recording::Campaign& campaign : campaigns) {
             const auto done = static_cast<double>(models.size()), all = static_cast<double>(campaigns.size());
             models.push_back(calibration::calibrate(
                 campaign, SPOOLFLOW_VERSION,
                 [&](const std::string& step, double share) { check(progress, step, (done + share) / all); },
                 despite_doubts ? calibration::Contradictions::noted : calibration::Contradictions::refused));
             for (std::string& note : resampled_in(models.back())) out.notes.push_back(std::move(note));
           }
           model::Model& first = models.front();
           if (models.size() > 1) {
             const auto tolerances = calibration::tolerances_of(campaigns);
             first = calibration::type_of_units(models, tolerances).model;
           } else if (as_type) {
             first =
                 calibration::type_model(std::move(first), calibration::tolerances_from(campaigns.front().tolerances));
           }
           out.page = page_of(units, [&](std::ostream& page, const report::ReaderUnits& in) {
             report::write_calibration_report(page, first, in);
           });
           out.model = kept(first);
           return out;
         })
      .tuple();
}

/// Of one unit of a type; `type_file` holds the type's model.
py::tuple calibrate_unit(const Path& file, bool allow_outside, const Path& type_file, const py::object& progress) {
  return at_work([&](SignalCheck& check) {
           const model::Model type = model::read_model(type_file);
           const recording::Campaign campaign =
               recording::read_unit_campaign(file, calibration::valve_of_type(type), outside(allow_outside));
           const calibration::CalibratedUnit unit = calibration::calibrate_unit(
               type, type_file.string(), campaign, SPOOLFLOW_VERSION,
               [&](const std::string& step, double share) { check(progress, step, share); });
           Made out{kept(unit.model)};
           for (const calibration::UnitCalibration& direction : unit.directions) {
             for (const calibration::UnitParameter& each : direction.parameters) {
               if (!each.marginal) continue;
               out.notes.push_back(fmt::format("{}: at the type's edge, {:.1f} standard deviations from its mean",
                                               each.name, each.deviations));
             }
           }
           return out;
         })
      .tuple();
}

model::Adaptation how_from(const SharedModel& model) {
  return {SPOOLFLOW_VERSION, model::creation_time(), model::sha256_of_text(model->text), {}, {}};
}

py::tuple with_findings(const calibration::RecalibratedValve& valve) {
  return Made{kept(valve.model), {}, valve.findings}.tuple();
}

/// By what the machine knows of its oil; the notes are what was changed or stays.
py::tuple recalibrate(const SharedModel& model, const std::vector<Path>& recordings,
                      const std::optional<Path>& channels, const Path& references) {
  return with_findings(at_work([&](SignalCheck&) {
    const recording::ChannelMap map = channels ? recording::read_channel_map(*channels) : recording::ChannelMap{};
    return apps::recalibrated(model->model, {recordings, map, recording::read_references(references)}, how_from(model));
  }));
}

/// Recordings that the campaign names, or that of a unit of the type in that file.
std::vector<Path> campaign_files(const Path& file, const std::optional<Path>& type_file) {
  const recording::Campaign campaign =
      type_file ? recording::read_unit_campaign(file, calibration::valve_of_type(model::read_model(*type_file)),
                                                recording::OutsideFiles::allowed)
                : recording::read_campaign(file, recording::OutsideFiles::allowed);
  std::vector<Path> out;
  for (const recording::CampaignRecording& each : campaign.recordings) out.push_back(each.file);
  return out;
}

/// The model with what that machine leaves open: "bench", "machine" or a TOML file.
SharedModel in_environment(const SharedModel& model, const std::string& environment) {
  return at_work([&](SignalCheck&) {
    model::Model out = model->model;
    calibration::apply(recording::read_environment(environment), out);
    return kept(out);
  });
}

}  // namespace

void add_calibrations(py::module_& module) {
  module.def("calibrate", &calibrate);
  module.def("calibrate_unit", &calibrate_unit);
  module.def("recalibrate", &recalibrate);
  module.def("gone_back", [](const SharedModel& model, std::size_t state) {
    return kept(calibration::gone_back(model->model, state, how_from(model)).model);
  });
  module.def("drift", [](const SharedModel& model) -> std::optional<std::string> {
    const std::vector<std::string> drifts = monitor::drift_texts(model->model);
    return drifts.empty() ? std::nullopt : std::optional(fmt::format("{}", fmt::join(drifts, "; ")));
  });
  module.def("campaign_files", &campaign_files);
  module.def("in_environment", &in_environment);
}

}  // namespace spoolflow::python
