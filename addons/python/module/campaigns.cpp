#include <filesystem>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "addons/python/module/bindings.hpp"
#include "addons/python/module/read_recording.hpp"
#include "addons/python/module/signal_check.hpp"
#include "spoolflow/parallel/for_each.hpp"
#include "spoolflow/rig/bench/recording_file.hpp"
#include "spoolflow/rig/bench/virtual_campaign.hpp"

namespace spoolflow::python {
namespace {

namespace py = pybind11;

std::vector<rig::CampaignItem> items_of(const rig::ValveAndCampaign& known, bool calibration_only) {
  return calibration_only ? rig::calibration_items(known.valve, known.campaign)
                          : rig::campaign_items(known.valve, known.campaign);
}

/// How a campaign's recordings are handed to Python.
struct CampaignRequest {
  std::string valve;  ///< a valve file or the name of a preset
  bool calibration_only;
  bool with_truth;
  bool as_text;  ///< of the files that the command writes; else as recordings
  unsigned workers;
};

/// campaign.toml, and the files that it stands beside, before any is made.
std::pair<std::string, std::vector<std::string>> outline(const std::string& valve, bool calibration_only) {
  const rig::ValveAndCampaign known = rig::read_valve_and_campaign(valve);
  const auto items = items_of(known, calibration_only);
  std::vector<std::string> files;
  for (const rig::CampaignItem& item : items) files.push_back(item.file);
  return {rig::campaign_text(known.valve, items), files};
}

/// Calls `store(file, recording, truth)` with each recording as it is finished, from any thread; returns campaign.toml.
std::string campaign(const CampaignRequest& asked, const py::object& store, const py::object& progress) {
  return at_work([&](SignalCheck& check) {
    const rig::ValveAndCampaign known = rig::read_valve_and_campaign(asked.valve);
    const auto items = items_of(known, asked.calibration_only);
    const auto keep = [&](const rig::CampaignItem& item, const rig::BenchRun& run, const rig::Simulation& simulation) {
      std::ostringstream text, truth;
      if (asked.as_text) {
        rig::write_recording(text, simulation.recording, run);
        if (asked.with_truth) rig::write_truth(truth, simulation.truth);
      }
      const py::gil_scoped_acquire lock;
      if (!asked.as_text) {
        const py::tuple objects = simulated_objects(simulation, item.file);
        store(item.file, objects[0], objects[1]);
      } else {
        store(item.file, std::move(text).str(), asked.with_truth ? py::object(py::str(truth.str())) : py::none());
      }
    };
    rig::run_campaign(items, {.store = keep,
                              .progress = [&](double share) { check(progress, share); },
                              .workers = asked.workers == 0 ? parallel::cores() : asked.workers,
                              .with_truth = asked.with_truth});
    return rig::campaign_text(known.valve, items);
  });
}

}  // namespace

void add_campaigns(py::module_& module) {
  module.def("campaign_outline", &outline);
  module.def("is_virtual_campaign",
             [](const std::string& file) { return rig::is_virtual_campaign(std::filesystem::path(file)); });
  module.def("campaign", [](const std::string& valve, bool calibration_only, bool with_truth, bool as_text,
                            unsigned workers, const py::object& store, const py::object& progress) {
    return campaign({valve, calibration_only, with_truth, as_text, workers}, store, progress);
  });
}

}  // namespace spoolflow::python
