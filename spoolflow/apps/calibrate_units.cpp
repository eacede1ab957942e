#include "spoolflow/apps/calibrate_units.hpp"

#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "spoolflow/apps/terminal/output_file.hpp"
#include "spoolflow/apps/terminal/progress.hpp"
#include "spoolflow/apps/terminal/suggestion.hpp"
#include "spoolflow/apps/terminal/terminal_text.hpp"
#include "spoolflow/apps/tool_version.hpp"
#include "spoolflow/apps/work/readable_model.hpp"
#include "spoolflow/calibration/type/calibrate_unit.hpp"
#include "spoolflow/calibration/type/series.hpp"
#include "spoolflow/report/series/series_report.hpp"

namespace spoolflow::apps {
namespace {

/// What each parameter was known to, is, and is known to.
void print_unit(const calibration::UnitCalibration& unit) {
  say("{}: a unit of {}\n", unit.model.valve.name, unit.model.type->name);
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
  say("{} units, {} refused\n", series.units.size(), series.refused());
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

calibration::UnitCalibration calibrate_unit(const CalibrateArguments& arguments, const CalibrationTask& task,
                                            const model::Model& type) {
  refuse_other_kinds("calibrate", {{task.campaign, FileKind::settings}});
  const recording::Campaign campaign = recording::read_unit_campaign(
      task.campaign, calibration::valve_of_type(type),
      arguments.allow_outside ? recording::OutsideFiles::allowed : recording::OutsideFiles::refused);
  std::vector<std::filesystem::path> inputs = files_of(campaign);
  inputs.emplace_back(arguments.type);
  OutputFile output(task.model, inputs);
  Progress progress("calibrating", arguments.quiet);
  calibration::UnitCalibration unit = calibration::calibrate_unit(
      type, arguments.type, campaign, std::string(tool_version()), [&](const std::string& step, double share) {
        progress.task(step);
        progress.update(share);
      });
  output.stream() << readable_text(unit.model, task.model);
  commit_together({&output});
  if (!arguments.quiet) print_unit(unit);
  return unit;
}

/// The page of the series and the type as its units are, where they are asked for.
void write_series(const CalibrateArguments& arguments, const std::vector<CalibrationTask>& tasks,
                  const model::Model& type, std::vector<calibration::SeriesUnit> units) {
  const report::ReaderUnits reader_units(arguments.units);
  std::vector<std::filesystem::path> used{arguments.type};
  for (const CalibrationTask& task : tasks) used.insert(used.end(), {task.campaign, task.model});
  std::unique_ptr<OutputFile> page, updated;
  if (!arguments.report.empty()) page = std::make_unique<OutputFile>(arguments.report, used);
  used.emplace_back(arguments.report);
  if (!arguments.updated_type.empty()) updated = std::make_unique<OutputFile>(arguments.updated_type, used);
  const calibration::Series series = calibration::compare_series(type, arguments.type, std::move(units));
  if (page) {
    const std::string origin = fmt::format("{}, spoolflow {}", model::creation_time(), tool_version());
    report::write_series_report(page->stream(), series, origin, reader_units);
  }
  if (updated) updated->stream() << readable_text(calibration::updated_type(type, series), arguments.updated_type);
  commit_together({page.get(), updated.get()});
  if (!arguments.quiet) print_series(series);
}

}  // namespace

void calibrate_units(const CalibrateArguments& arguments, const std::vector<CalibrationTask>& tasks,
                     const Attempt& attempt) {
  const model::Model type = model::read_model(arguments.type);
  std::vector<calibration::SeriesUnit> units;
  for (const CalibrationTask& task : tasks) {
    attempt([&] {
      try {
        units.push_back(calibration::series_unit(calibrate_unit(arguments, task, type)));
      } catch (const calibration::ForeignUnit& foreign) {
        units.push_back(calibration::series_unit(foreign.unit));
        throw;
      }
    });
  }
  if (arguments.report.empty() && arguments.updated_type.empty()) return;
  attempt([&] { write_series(arguments, tasks, type, std::move(units)); });
}

}  // namespace spoolflow::apps
