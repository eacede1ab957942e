/// `spoolflow plan`: the strokes after which a unit is known best in the time that there is.
#include <cmath>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "spoolflow/apps/command.hpp"
#include "spoolflow/apps/commands.hpp"
#include "spoolflow/apps/terminal/input_kind.hpp"
#include "spoolflow/apps/terminal/output_file.hpp"
#include "spoolflow/apps/terminal/terminal_text.hpp"
#include "spoolflow/calibration/type/plan_minute.hpp"
#include "spoolflow/estimation/running_sensor.hpp"
#include "spoolflow/rig/bench/virtual_campaign.hpp"
#include "spoolflow/uncertainty/operating_point.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::apps {
namespace {

struct PlanArguments {
  std::string type, table, scenario, valve;
  double seconds = 60;
  bool quiet = false;
};

constexpr double per_cent = 100;

void write_table(std::ostream& out, const calibration::PlannedMinute& minute) {
  out << "time_s,position_set_percent,pressure_difference_set_bar,dither_A\n";
  for (const calibration::PlannedCorner& corner : minute.corners()) {
    out << fmt::format("{:.2f},{:g},{:.2f},0\n", corner.time_s, per_cent * corner.position_share,
                       units::bar_from_Pa(corner.pressure_Pa));
  }
}

std::string pressures_bar(const calibration::PlannedMinute& minute) {
  std::string out;
  for (const double pressure_Pa : minute.pressures_Pa)
    out += fmt::format("{}{:.2f}", out.empty() ? "" : ", ", units::bar_from_Pa(pressure_Pa));
  return out;
}

void write_scenario(std::ostream& out, const calibration::PlannedMinute& minute, const std::string& valve) {
  out << fmt::format(
      "# The planned strokes of a unit, for the virtual rig.\nprotocol = \"ramps\"\nvalve = \"{}\"\n\n[run]\n"
      "pressure_differences_bar = [{}]\nrate_percent_per_s = {:g}\n{}hold_s = {:g}\npause_s = {:g}\n\n"
      "[electronics.dither]\namplitude_A = 0\n",
      valve, pressures_bar(minute), per_cent * minute.rate_per_s,
      minute.both_ways ? "second_peak_percent = -100\n" : "", calibration::planned_hold_s,
      calibration::planned_pause_s);
}

/// Half the width of the full sensor's 95 % band [share of the rated flow], mean over openings, pressure differences
/// and both ways of a spool that slides, from samples that the model itself would show. NaN where no point of the maps
/// can be reached. Keep out: models without the full sensor and of whole valves.
double expected_half_width(const model::Model& model) {
  const sensor::ObserverParameters<double>& valve = model.observer->parameters;
  const double highest_Pa = valve.edge.highest_pressure_difference_Pa(), rated = model.valve.rated_flow_m3_per_s;
  double sum = 0;
  int points = 0;
  for (const double opening : {0.25, 0.4, 0.55, 0.7, 0.85}) {
    for (const double pressure : {0.25, 0.5, 0.75, 0.95}) {
      for (const bool opens : {true, false}) {
        const auto course = uncertainty::course_to(model, {.position_m = opening * model.valve.stroke_m,
                                                           .pressure_difference_Pa = pressure * highest_Pa,
                                                           .oil_temperature_K = valve.edge.temperature_K.at(1),
                                                           .opening = opens});
        if (!course) continue;
        estimation::RunningSensor sensor(&valve, rated);
        sensor::Estimate<double> answer{};
        for (const estimation::TimedSample& sample : *course) sensor.step(sample, answer);
        sum += 0.5 * (answer.flow_upper_m3_per_s - answer.flow_lower_m3_per_s) / rated;
        ++points;
      }
    }
  }
  return points > 0 ? sum / points : std::nan("");
}

void print_plan(const model::Model& type, const calibration::PlannedMinute& minute) {
  say("{} strokes{} at {:g} %/s, {:.1f} s, at {} bar\n", minute.pressures_Pa.size(),
      minute.both_ways ? " either way" : "", per_cent * minute.rate_per_s, minute.corners().back().time_s,
      pressures_bar(minute));
  constexpr double deviations_of_95 = 1.96;
  say("  {:<52} {:>7} {:>7}\n", "95 %, of the rated flow, sliding, mean over the range", "before", "after");
  say("  {:<52} {:>6.2f}% {:>6.2f}%\n", "what units of the type differ by",
      per_cent * deviations_of_95 * minute.before_share, per_cent * deviations_of_95 * minute.after_share);
  say("  {:<52} {:>6.2f}% {:>6.2f}%\n", "the sensor's band", per_cent * expected_half_width(type),
      per_cent * expected_half_width(calibration::planned_unit(type, minute)));
}

/// The valve as a scenario names it: a built-in one, or a file by its path from the scenario's folder. Throws
/// SettingsError where `simulate` could not read it, std::invalid_argument for one of other directions than the type's.
std::string valve_in_scenario(const PlanArguments& arguments, const model::Model& type) {
  const std::string usual = type.whole() ? "whole_size_6" : "size_6";
  const std::string& valve = arguments.valve.empty() ? usual : arguments.valve;
  if (rig::read_valve_and_campaign(valve).valve.whole != type.whole()) {
    throw std::invalid_argument(
        fmt::format("--valve {} {}, and the type {} {}: `calibrate --type` would not take its recording; give one such "
                    "as {}",
                    valve, type.whole() ? "is not whole" : "is whole", arguments.type,
                    type.whole() ? "is of both directions" : "is of one", usual));
  }
  if (!valve.ends_with(".toml")) return valve;
  const std::filesystem::path folder = std::filesystem::absolute(arguments.scenario).parent_path();
  return std::filesystem::proximate(valve, folder).generic_string();
}

void plan(const PlanArguments& arguments) {
  apps::refuse_other_kinds("plan", {{arguments.type, FileKind::model}});
  const model::Model type = model::read_model(arguments.type);
  Outputs outputs({arguments.type, arguments.valve});
  OutputFile& table = outputs.open(arguments.table);
  OutputFile* const scenario = outputs.open_if_named(arguments.scenario);
  const std::string valve = scenario == nullptr ? "" : valve_in_scenario(arguments, type);
  const calibration::PlannedMinute minute = calibration::plan_minute(type, arguments.type, arguments.seconds);
  write_table(table.stream(), minute);
  if (scenario != nullptr) write_scenario(scenario->stream(), minute, valve);
  outputs.commit();
  if (!arguments.quiet) print_plan(model::of_direction(type, "b"), minute);
}

}  // namespace

void add_plan_command(CLI::App& program) {
  CLI::App* command = add_command(
      program,
      {.name = "plan",
       .purpose = "plan the strokes after which a unit of a type is known best",
       .reads = "a type's model, as `calibrate --as-type` writes it",
       .writes = "a table of corners (CSV), straight lines between: time, set position, pressure difference and "
                 "dither; and on request a scenario of the same for the virtual rig",
       .examples = {"spoolflow plan type_a.json --seconds 60 -o plan.csv",
                    "spoolflow plan type_a.json -o plan.csv --scenario plan.toml --valve size_6"}});
  auto arguments = std::make_shared<PlanArguments>();
  command->add_option("type", arguments->type, "model of a type")->type_name("TYPE.json")->required();
  command->add_option("-o,--output", arguments->table, "table to write, - for standard output")
      ->type_name("PLAN.csv")
      ->required();
  command->add_option("--seconds", arguments->seconds, "of recording at most, 60 unless given")
      ->type_name("S")
      ->check(between(1.0, 3600.0));
  CLI::Option* scenario =
      command->add_option("--scenario", arguments->scenario, "the same as a scenario for `spoolflow simulate`")
          ->type_name("SCENARIO.toml");
  command
      ->add_option("--valve", arguments->valve,
                   "built-in valve or file of the scenario: size_6, whole_size_6 unless given")
      ->type_name("VALVE")
      ->needs(scenario);
  add_quiet(*command, arguments->quiet);
  command->callback([arguments] { plan(*arguments); });
}

}  // namespace spoolflow::apps
