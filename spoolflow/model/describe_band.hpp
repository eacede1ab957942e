#pragma once
/// How sure the observer may be, and what the machine leaves open, each number described once; see parameter.hpp.
#include "spoolflow/model/parameter.hpp"
#include "spoolflow/sensor/observer.hpp"

namespace spoolflow::model {

template <class Band, class Visitor>
void describe_band(Band& band, Visitor& visitor) {
  visitor.number(
      {"band_friction_share", "1", {0, 10}, "standard deviation of sliding friction about its map, as a share of it"},
      band.friction_share);
  visitor.number({"band_force_residual_N", "N", {1e-6, 1e4}, "standard deviation of all force maps together"},
                 band.force_residual_N);
  visitor.number({"band_flow_residual_m3_per_s", "m3/s", {0, 1}, "standard deviation of the flow about its map"},
                 band.flow_residual_m3_per_s);
  visitor.number({"band_coverage_factor", "1", {0.1, 100}, "standard deviations in the 95 % band"},
                 band.coverage_factor);
  visitor.number(
      {"band_force_share", "1", {1e-3, 10}, "how much of the forces' errors the band counts while the spool slides"},
      band.force_share);
  visitor.number(
      {"band_rest_share", "1", {1e-3, 100}, "how much of the forces' errors the band counts while the spool rests"},
      band.rest_share);
  visitor.number({"band_tolerance_N",
                  "N",
                  {0, 1e4},
                  "how far friction at rest may lie outside of what the pre-sliding displacement bounds, one "
                  "standard deviation as the band counts it: friction_tolerance_N scaled by how the forces' "
                  "errors proved on operating recordings"},
                 band.tolerance_N);
  visitor.number(
      {"band_creep_per_s", "1/s", {0, 10}, "growth of that tolerance with the time at rest, as a share of it"},
      band.creep_per_s);
  visitor.number({"band_unobserved_factor",
                  "1",
                  {1e-3, 100},
                  "standard deviation of unobserved changes of pressure over the most restless random walk"},
                 band.unobserved_factor);
}

template <class Limits, class Visitor>
void describe_current_limits(Limits& limits, Visitor& visitor) {
  visitor.number({.key = "largest_current_jump_A",
                  .unit = "A",
                  .limits = {0, 1e3},
                  .meaning = "the coil current changes by no more at once: eddy currents and noise; 0: not known",
                  .otherwise = 0},
                 limits.jump_A);
  visitor.number({.key = "fastest_current_A_per_s",
                  .unit = "A/s",
                  .limits = {0, 1e7},
                  .meaning = "and by so much more with the time: largest voltage over least incremental inductance",
                  .otherwise = 0},
                 limits.slope_A_per_s);
}

template <class Environment, class Visitor>
void describe_environment(Environment& environment, Visitor& visitor) {
  const auto number = [&](const char* key, const char* unit, Limits limits, const char* meaning, auto& value) {
    visitor.number({.key = key, .unit = unit, .limits = limits, .meaning = meaning, .otherwise = 0}, value);
  };
  number("environment_position_m", "m", {0, 1e-2}, "standard uncertainty of the position's zero",
         environment.position_m);
  number("environment_position_share", "1", {0, 1}, "standard uncertainty of the position's gain",
         environment.position_share);
  number("environment_oil_temperature_K", "K", {0, 100},
         "standard uncertainty of the oil temperature, and what an unknown viscosity comes to",
         environment.oil_temperature_K);
  number("environment_current_share", "1", {0, 1}, "standard uncertainty of the current's gain",
         environment.current_share);
  number("environment_force_N", "N", {0, 1e4}, "standard deviation of forces on the spool from outside: vibration",
         environment.force_N);
  number("environment_friction_share", "1", {0, 10}, "standard uncertainty of friction", environment.friction_share);
  number("environment_dithered_loop_A", "A", {0, 1e3}, "standard uncertainty of the magnetic loop under dither",
         environment.dithered_loop_A);
  number("environment_ripple_Pa", "Pa", {0, 1e9}, "amplitude of the pressure difference's ripple",
         environment.ripple_Pa);
  number("environment_flow_share", "1", {0, 1}, "standard uncertainty of the conductance", environment.flow_share);
  number("environment_leakage_m3_per_s", "m3/s", {0, 1}, "standard uncertainty of leakage past the metering edge",
         environment.leakage_m3_per_s);
  number("environment_highest_pressure_Pa", "Pa", {0, 1e9},
         "highest pressure difference that is answered; 0: the calibrated one", environment.highest_pressure_Pa);
}

}  // namespace spoolflow::model
