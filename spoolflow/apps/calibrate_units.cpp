#include "spoolflow/apps/calibrate_units.hpp"

#include <algorithm>
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
#include "spoolflow/calibration/type/several_units.hpp"
#include "spoolflow/calibration/type/type_model.hpp"
#include "spoolflow/report/series/series_report.hpp"

namespace spoolflow::apps {
namespace {

/// How far apart units of the type lie beside what was taken before.
void print_type(const calibration::SeveralUnits& compared, const calibration::Deviations& tolerances) {
  say("  {:<18} {:>10} {:>10}   from the middle\n", "between units", "tolerance", "spread");
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
      progress.task(fmt::format("{}: {}", campaign.valve.name, step));
      progress.update((done + share) / static_cast<double>(campaigns.size()));
    }));
    for (const std::string& doubt : units.back().provenance.doubts)
      say("spoolflow: doubt: {}: {}\n", campaign.valve.name, doubt);
  }
  const calibration::SeveralUnits compared = calibration::compare_units(units, tolerances);
  output.stream() << readable_text(calibration::type_of(units, compared), arguments.model);
  commit_together({&output});
  if (!arguments.quiet) print_type(compared, tolerances);
}

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
