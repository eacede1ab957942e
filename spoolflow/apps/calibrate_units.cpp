#include "spoolflow/apps/calibrate_units.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>

#include <fmt/format.h>

#include "spoolflow/apps/terminal/input_kind.hpp"
#include "spoolflow/apps/terminal/output_file.hpp"
#include "spoolflow/apps/terminal/progress.hpp"
#include "spoolflow/apps/terminal/terminal_text.hpp"
#include "spoolflow/apps/tool_version.hpp"
#include "spoolflow/apps/work/readable_model.hpp"
#include "spoolflow/calibration/numerics/calibration_error.hpp"
#include "spoolflow/calibration/type/calibrate_unit.hpp"
#include "spoolflow/calibration/type/series.hpp"
#include "spoolflow/calibration/type/several_units.hpp"
#include "spoolflow/calibration/type/type_model.hpp"
#include "spoolflow/model/sha256.hpp"
#include "spoolflow/report/series/series_report.hpp"

namespace spoolflow::apps {
namespace {

/// Of which direction of flow, where the model is of the whole valve.
std::string of_direction(const model::Model& whole, std::size_t k) {
  return whole.whole() ? fmt::format(", {}", model::flow_of(model::directions(whole)[k])) : "";
}

/// How far apart units of the type lie beside what was taken before.
void print_type(const std::string& direction, const calibration::SeveralUnits& compared,
                const calibration::Deviations& tolerances) {
  say("  {:<18} {:>10} {:>10}   from the middle\n", "between units" + direction, "tolerance", "spread");
  for (std::size_t k = 0; k < calibration::variations; ++k) {
    const calibration::VariationAbout& about = calibration::all_variations()[k];
    const auto [scale, unit_name] = calibration::written_unit(about.unit);
    const auto row = static_cast<Eigen::Index>(k);
    std::string units;
    for (const calibration::MeasuredUnit& unit : compared.units)
      units += fmt::format(" {:+.2g}", scale * unit.deviations[k]);
    say("  {:<18} {:>10.3g} {:>10.3g} {:<2}{}\n", about.name, scale * tolerances[k],
        scale * std::sqrt(compared.next.covariance(row, row)), unit_name, units);
  }
  for (const calibration::MeasuredUnit& unit : compared.units)
    say("  {}: {:.2g} N of its balance of forces are explained by none of them\n", unit.name, unit.force_left_N);
}

/// What each parameter was known to, is, and is known to.
void print_unit(const std::string& direction, const calibration::UnitCalibration& unit) {
  say("{}: a unit of {}{}\n", unit.model.valve.name, unit.model.type->name, direction);
  say("  {:<18} {:>10} {:>10} {:>10}\n", "against the type", "tolerance", "is", "known to");
  for (const calibration::UnitParameter& parameter : unit.parameters) {
    const auto [scale, unit_name] = calibration::written_unit(parameter.unit);
    say("  {:<18} {:>10.3g} {:>+10.3g} {:>10.3g} {}{}\n", parameter.name, parameter.tolerance * scale,
        parameter.value * scale, parameter.uncertainty * scale, unit_name,
        parameter.marginal ? fmt::format("  <- AT THE TYPE'S EDGE, {:.1f} standard deviations", parameter.deviations)
        : parameter.seen   ? ""
                           : "  not seen by these recordings");
  }
}

/// How the units differ beside what the type took.
void print_series(const calibration::Series& series) {
  say("{} units{}, {} refused\n", series.units.size(), series.direction, series.refused());
  say("  {:<18} {:>10} {:>10} {:>10} {:>6}\n", "between units", "tolerance", "spread", "mean", "Cpk");
  for (const calibration::SeriesParameter& each : series.parameters) {
    const auto [scale, unit_name] = calibration::written_unit(each.unit);
    if (each.seen == 0) {
      say("  {:<18} {:>10.3g} {:>10} {:>10} {:>6} {}  shown by no unit\n", each.name, scale * each.tolerance, "-", "-",
          "-", unit_name);
      continue;
    }
    say("  {:<18} {:>10.3g} {:>10.3g} {:>+10.3g} {:>6} {}{}\n", each.name, scale * each.tolerance, scale * each.spread,
        scale * each.mean, std::isnan(each.capability) ? "-" : fmt::format("{:.2f}", each.capability), unit_name,
        each.drifts ? fmt::format("  <- DRIFTS, {:+.3g} over 100 units", 100 * scale * each.drift_per_serial) : "");
  }
  if (series.units.size() - series.refused() < calibration::least_for_capability)
    say("  Cpk from {} units of the type on: fewer do not show it\n", calibration::least_for_capability);
}

/// Whose it is: the recording of a unit by its checksum, and the unit's file by its name.
struct SeenUnits {
  std::map<std::string, std::filesystem::path> recordings, names;
};

/// Throws CalibrationError where one of the unit's recordings is another unit's.
void require_own_recordings(SeenUnits& seen, const recording::Campaign& unit) {
  for (const recording::CampaignRecording& entry : unit.recordings) {
    const auto [other, is_new] = seen.recordings.emplace(model::sha256_of_file(entry.file), entry.file);
    if (is_new || std::filesystem::equivalent(other->second.parent_path(), entry.file.parent_path())) continue;
    throw calibration::CalibrationError(
        fmt::format("{}: {} and {} are the same file, and no two units measure the same: give the unit's own recording",
                    unit.file.string(), entry.file.string(), other->second.string()));
  }
}

void doubt_name_of_another(SeenUnits& seen, const recording::Campaign& unit) {
  const auto [other, is_new] = seen.names.emplace(unit.valve.name, unit.file);
  if (is_new) return;
  say("spoolflow: doubt: {}: the name is {}, as in {}, and pages and monitors tell units apart by it: give each unit "
      "its "
      "own\n",
      unit.file.string(), unit.valve.name, other->second.string());
}

calibration::CalibratedUnit calibrate_unit(const CalibrateArguments& arguments, const CalibrationTask& task,
                                           const model::Model& type, SeenUnits& seen) {
  refuse_other_kinds("calibrate", {{task.campaign, FileKind::settings}});
  const recording::Campaign campaign = recording::read_unit_campaign(
      task.campaign, calibration::valve_of_type(type),
      arguments.allow_outside ? recording::OutsideFiles::allowed : recording::OutsideFiles::refused);
  require_own_recordings(seen, campaign);
  doubt_name_of_another(seen, campaign);
  std::vector<std::filesystem::path> inputs = files_of(campaign);
  inputs.emplace_back(arguments.type);
  OutputFile output(task.model, inputs);
  Progress progress("calibrating", arguments.quiet);
  calibration::CalibratedUnit unit =
      calibration::calibrate_unit(type, arguments.type, campaign, std::string(tool_version()),
                                  [&](const std::string& step, double share) { progress.update(step, share); });
  output.stream() << readable_text(unit.model, task.model);
  output.commit();
  for (const std::string& doubt : unit.model.provenance.doubts)
    say("spoolflow: doubt: {}: {}\n", unit.model.valve.name, doubt);
  for (std::size_t k = 0; !arguments.quiet && k < unit.directions.size(); ++k)
    print_unit(of_direction(type, k), unit.directions[k]);
  return unit;
}

/// The page of the series and the type as its units are, where they are asked for.
void write_series(const CalibrateArguments& arguments, const std::vector<CalibrationTask>& tasks,
                  const model::Model& type, const std::vector<std::vector<calibration::SeriesUnit>>& units) {
  if (units.front().size() < calibration::least_in_series) {
    throw std::invalid_argument(
        fmt::format("nothing is written of the series: {} of its {} units could be compared with their type, and a "
                    "series has {} and more; mend the units that are named above",
                    units.front().size(), tasks.size(), calibration::least_in_series));
  }
  const report::ReaderUnits reader_units(arguments.units);
  std::vector<std::filesystem::path> used{arguments.type};
  for (const CalibrationTask& task : tasks) used.insert(used.end(), {task.campaign, task.model});
  Outputs outputs(used);
  OutputFile* const page = outputs.open_if_named(arguments.report);
  OutputFile* const updated = outputs.open_if_named(arguments.updated_type);
  std::vector<calibration::Series> series;
  model::Model next = type;
  for (const std::string& direction : model::directions(type)) {
    const model::Model of_one = model::of_direction(type, direction);
    series.push_back(calibration::compare_series(of_one, arguments.type, units.at(series.size())));
    series.back().direction = of_direction(type, series.size() - 1);
    if (updated != nullptr) model::put_direction(next, direction, calibration::updated_type(of_one, series.back()));
  }
  if (page != nullptr) {
    const std::string origin = fmt::format("{}, spoolflow {}", model::creation_time(), tool_version());
    report::write_series_report(page->stream(), series, origin, reader_units);
  }
  if (updated != nullptr) updated->stream() << readable_text(next, arguments.updated_type);
  outputs.commit();
  if (arguments.quiet) return;
  for (const calibration::Series& each : series) print_series(each);
}

}  // namespace

void calibrate_type(const CalibrateArguments& arguments) {
  std::vector<recording::Campaign> campaigns;
  std::vector<std::filesystem::path> inputs;
  for (const std::string& file : arguments.campaigns) {
    campaigns.push_back(read_campaign(arguments, file));
    std::ranges::copy(files_of(campaigns.back()), std::back_inserter(inputs));
  }
  const calibration::Deviations tolerances = calibration::tolerances_of(campaigns);
  OutputFile output(arguments.model, inputs);
  Progress progress("calibrating", arguments.quiet);
  std::vector<model::Model> units;
  for (const recording::Campaign& campaign : campaigns) {
    const auto done = static_cast<double>(units.size());
    units.push_back(calibrated(campaign, arguments.despite_doubts, [&](const std::string& step, double share) {
      progress.update(fmt::format("{}: {}", campaign.valve.name, step),
                      (done + share) / static_cast<double>(campaigns.size()));
    }));
    for (const std::string& doubt : units.back().provenance.doubts)
      say("spoolflow: doubt: {}: {}\n", campaign.valve.name, doubt);
  }
  const calibration::TypeOfUnits type = calibration::type_of_units(units, tolerances);
  output.stream() << readable_text(type.model, arguments.model);
  output.commit();
  for (std::size_t k = 0; !arguments.quiet && k < type.compared.size(); ++k)
    print_type(of_direction(type.model, k), type.compared[k], tolerances);
}

void calibrate_units(const CalibrateArguments& arguments, const std::vector<CalibrationTask>& tasks,
                     const Attempt& attempt) {
  const model::Model type = model::read_model(arguments.type);
  std::vector<std::vector<calibration::SeriesUnit>> units(model::directions(type).size());
  const auto add = [&](const std::vector<calibration::UnitCalibration>& directions) {
    for (std::size_t k = 0; k < directions.size(); ++k) units[k].push_back(calibration::series_unit(directions[k]));
  };
  SeenUnits seen;
  for (const CalibrationTask& task : tasks) {
    attempt([&] {
      try {
        add(calibrate_unit(arguments, task, type, seen).directions);
      } catch (const calibration::ForeignUnit& foreign) {
        add(foreign.directions);
        throw;
      }
    });
  }
  if (arguments.report.empty() && arguments.updated_type.empty()) return;
  attempt([&] { write_series(arguments, tasks, type, units); });
}

}  // namespace spoolflow::apps
