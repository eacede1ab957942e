#pragma once
/// What the machine around the valve leaves open, each described once; see parameter.hpp. Older models know none: the
/// bench, and pressure differences up to the calibrated one.
#include "spoolflow/model/parameter.hpp"
#include "spoolflow/sensor/observer_parameters.hpp"

namespace spoolflow::model {

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
  number("environment_position_m", "m", {0, 1e-2}, "standard uncertainty of the position's zero", environment.position_m);
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
  number("environment_ripple_Pa", "Pa", {0, 1e9}, "amplitude of the pressure difference's ripple",
         environment.ripple_Pa);
  number("environment_flow_share", "1", {0, 1}, "standard uncertainty of the conductance", environment.flow_share);
  number("environment_leakage_m3_per_s", "m3/s", {0, 1}, "standard uncertainty of leakage past the metering edge",
         environment.leakage_m3_per_s);
  number("environment_highest_pressure_Pa", "Pa", {0, 1e9},
         "highest pressure difference that is answered; 0: the calibrated one", environment.highest_pressure_Pa);
}

}  // namespace spoolflow::model
