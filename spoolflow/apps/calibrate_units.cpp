#include "spoolflow/apps/calibrate_units.hpp"

#include <fmt/format.h>

#include "spoolflow/apps/suggestion.hpp"
#include "spoolflow/apps/terminal/output_file.hpp"
#include "spoolflow/apps/terminal/progress.hpp"
#include "spoolflow/apps/terminal/terminal_text.hpp"
#include "spoolflow/apps/tool_version.hpp"
#include "spoolflow/apps/work/readable_model.hpp"
#include "spoolflow/calibration/type/calibrate_unit.hpp"

namespace spoolflow::apps {
namespace {

/// What each parameter was known to, is, and is known to.
void print_unit(const calibration::UnitCalibration& unit) {
  say("{}: a unit of {}\n", unit.model.valve.name, unit.model.type->name);
  say("  {:<18} {:>10} {:>10} {:>10}\n", "against the type", "tolerance", "is", "known to");
  for (const calibration::UnitParameter& parameter : unit.parameters) {
    constexpr double percent = 100, um_per_m = 1e6;
    const bool length = parameter.unit == "m";
    const double scale = length ? um_per_m : percent;
    say("  {:<18} {:>10.3g} {:>+10.3g} {:>10.3g} {}{}\n", parameter.name, parameter.tolerance * scale,
        parameter.value * scale, parameter.uncertainty * scale, length ? "um" : "%",
        parameter.marginal ? fmt::format("  <- AT THE TYPE'S EDGE, {:.1f} standard deviations", parameter.deviations)
        : parameter.seen   ? ""
                           : "  not seen by these recordings");
  }
}

void calibrate_unit(const CalibrateArguments& arguments, const CalibrationTask& task, const model::Model& type) {
  refuse_other_kinds("calibrate", {{task.campaign, FileKind::settings}});
  const recording::Campaign campaign = recording::read_unit_campaign(
      task.campaign, calibration::valve_of_type(type),
      arguments.allow_outside ? recording::OutsideFiles::allowed : recording::OutsideFiles::refused);
  std::vector<std::filesystem::path> inputs = files_of(campaign);
  inputs.emplace_back(arguments.type);
  OutputFile output(task.model, inputs);
  Progress progress("calibrating", arguments.quiet);
  const calibration::UnitCalibration unit = calibration::calibrate_unit(
      type, arguments.type, campaign, std::string(tool_version()), [&](const std::string& step, double share) {
        progress.task(step);
        progress.update(share);
      });
  output.stream() << readable_text(unit.model, task.model);
  commit_together({&output});
  if (!arguments.quiet) print_unit(unit);
}

}  // namespace

void calibrate_units(const CalibrateArguments& arguments, const std::vector<CalibrationTask>& tasks,
                     const Attempt& attempt) {
  const model::Model type = model::read_model(arguments.type);
  for (const CalibrationTask& task : tasks) attempt([&] { calibrate_unit(arguments, task, type); });
}

}  // namespace spoolflow::apps
