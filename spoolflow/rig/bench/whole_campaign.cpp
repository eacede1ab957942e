#include "spoolflow/rig/bench/whole_campaign.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "spoolflow/rig/bench/campaign_loads.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::rig {
namespace {

/// The supply follows the set difference where the ports have a load.
OperationConditions at_work() {
  return {.supply_follows_difference = true};
}

void add_axial_force_maps(CampaignItems& items, const CampaignSettings& settings, const std::string& direction) {
  for (const FedEdges& fed : fed_edges(settings, direction)) {
    for (const double temperature_C : settings.oil_temperatures_C) {
      items.add_bench_test(
          fmt::format("axial_force_map_{:g}_{}.csv", temperature_C, fed.edge.empty() ? direction : fed.edge),
          "axial_force_map",
          AxialForceProtocol{.pressure_differences_bar = settings.pressure_differences_bar,
                             .oil_temperature_C = temperature_C,
                             .load = fed.load},
          direction, fed.edge);
    }
  }
}

/// The cylinder's random loads reach this share of what the supply could hold on either side.
DutyCycleProtocol duty_under_load(const ValveUnderTest& valve, const CampaignSettings& settings, double share) {
  const double supply_Pa = units::Pa_from_bar(settings.overrunning_pressure_bar);
  DutyCycleProtocol duty{
      .conditions = {.port_pressures = true}, .duration_s = settings.dithered_duty_s, .lowest_percent = -100};
  duty.conditions.supply_pressure_bar = settings.overrunning_pressure_bar;
  duty.lowest_load_N = -share * supply_Pa * valve.plant.load.piston_area_A_m2;
  duty.highest_load_N = share * supply_Pa * valve.plant.load.piston_area_B_m2;
  return duty;
}

void add_loads(CampaignItems& items, const CampaignSettings& settings) {
  const ValveUnderTest shaken = dithered(items.valve(), settings);
  DutyCycleProtocol duty{.conditions = at_work(), .duration_s = settings.dithered_duty_s, .lowest_percent = -100};
  items.add_with(shaken, "both_duty_dither.csv", "", duty);

  const double supply_bar =
      *std::max_element(settings.pressure_differences_bar.begin(), settings.pressure_differences_bar.end());
  duty.conditions = {.port_pressures = true};
  duty.conditions.supply_pressure_bar = supply_bar;  // the difference never leaves the calibrated range
  items.add_with(loaded(shaken, LoadKind::orifice, supply_bar), "both_orifice_dither.csv", "", duty);

  constexpr double overrunning = 0.4;   // both edges together then have 1.4 times the supply
  constexpr double regenerative = 1.4;  // more than the supply holds: oil flows back into it
  const ValveUnderTest moving = with_cylinder(items.valve());
  items.add_with(moving, "both_overrunning.csv", "", duty_under_load(moving, settings, overrunning));
  items.add_with(moving, "both_regenerative.csv", "", duty_under_load(moving, settings, regenerative));
}

}  // namespace

void add_whole_calibration(CampaignItems& items, const CampaignSettings& settings) {
  for (const std::string direction : {"b", "a"}) {
    items.add_bench_test("spring_" + direction + ".csv", "spring", protocol_named("spring"), direction);
    items.add_bench_test("solenoid_map_" + direction + ".csv", "solenoid_force_map",
                         protocol_named("solenoid_force_map"), direction);
    items.add_bench_test("solenoid_dynamic_" + direction + ".csv", "solenoid_dynamic",
                         protocol_named("solenoid_dynamic"), direction);
    add_axial_force_maps(items, settings, direction);
  }
  items.add(fmt::format("both_ramps_{:g}bar.csv", settings.ramp_pressure_bar), "operation",
            RampsProtocol{.conditions = at_work(),
                          .pressure_differences_bar = {settings.ramp_pressure_bar},
                          .rate_percent_per_s = settings.ramp_rate_percent_per_s,
                          .second_peak_percent = -100});
}

void add_whole_validation(CampaignItems& items, const CampaignSettings& settings) {
  const auto& levels_bar = settings.ramps_pressures_bar;
  RampsProtocol ramps{.conditions = at_work(),
                      .pressure_differences_bar = levels_bar,
                      .rate_percent_per_s = 10,
                      .second_peak_percent = -100,
                      .hold_s = 2,
                      .pause_s = 0};  // straight through the centre
  ramps.conditions.position_faults_per_s = settings.ramps_position_faults_per_s;
  items.add(fmt::format("both_ramps_{:g}_to_{:g}bar.csv", levels_bar.front(), levels_bar.back()), "", ramps);
  items.add("both_duty_1.csv", "",
            DutyCycleProtocol{.conditions = at_work(), .duration_s = settings.duty_cycle_s, .lowest_percent = -100});

  RampsProtocol sweep = ramps;
  sweep.conditions = at_work();
  sweep.conditions.oil_temperature_start_C = 30;
  sweep.conditions.oil_temperature_end_C = 75;
  sweep.pressure_differences_bar.assign(3, settings.sweep_pressure_bar);
  sweep.pause_s = 1;
  items.add("both_temperature_sweep.csv", "", sweep);

  PressureStepsProtocol steps{.conditions = at_work(), .positions_percent = {40, -40, 70, -70, 100, -100}};
  steps.hold_s = 1.5;
  items.add("both_pressure_steps.csv", "", steps);
  items.add("both_sine_sweep.csv", "",
            SineProtocol{.conditions = at_work(),
                         .centre_percent = 0,
                         .amplitude_percent = 40,
                         .frequency_end_Hz = settings.sweep_frequency_Hz,
                         .pressure_difference_bar = settings.sweep_pressure_bar});
  auto fast = std::get<DutyCycleProtocol>(protocol_named("fast_motion"));
  fast.conditions.supply_follows_difference = true;
  fast.lowest_percent = -95;
  items.add("both_fast_motion.csv", "", fast);
  add_loads(items, settings);
}

}  // namespace spoolflow::rig
