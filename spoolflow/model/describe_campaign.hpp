#pragma once
/// What is known of the valve as a whole and of the campaign's instruments, each described once; see parameter.hpp.
#include "spoolflow/model/parameter.hpp"

namespace spoolflow::model {

/// visitor.number(Parameter, number or optional number) of each; `Valve` may be const.
template <class Valve, class Visitor>
void describe_valve(Valve& valve, Visitor&& visitor) {
  visitor.number({"rated_flow_m3_per_s", "m3/s", {1e-7, 1}, "full scale of every figure in percent"},
                 valve.rated_flow_m3_per_s);
  visitor.number({"stroke_m", "m", {1e-5, 0.1}, "of the spool, from closed to open"}, valve.stroke_m);
  visitor.number({"load_area_ratio",
                  "1",
                  {0.1, 10},
                  "piston area at port A over that at port B; absent for equal flows over both edges"},
                 valve.load_area_ratio);
  visitor.number(
      {"open_stop_m", "m", {1e-5, 0.3}, "position where the spool meets its open stop; absent: none is known"},
      valve.open_stop_m);
  visitor.number({"moving_mass_kg",
                  "kg",
                  {1e-3, 100},
                  "spool, push rod and armature together; absent: found or assumed, see the observer"},
                 valve.moving_mass_kg);
}

/// visitor.number(Parameter, optional number) of each; `Instruments` may be const.
template <class Instruments, class Visitor>
void describe_instruments(Instruments& instruments, Visitor&& visitor) {
  const auto number = [&](const char* key, const char* unit, const char* meaning, auto& value) {
    visitor.number({.key = key, .unit = unit, .limits = {1e-12, 1e12}, .meaning = meaning}, value);
  };
  number("position_uncertainty_95_m", "m", "position as the campaign measured it, 95 %", instruments.position_m);
  number("current_uncertainty_95_A", "A", "coil current, 95 %", instruments.current_A);
  number("force_uncertainty_95_N", "N", "load cell, 95 %", instruments.force_N);
  number("pressure_uncertainty_95_Pa", "Pa", "pressures, 95 %", instruments.pressure_Pa);
  number("temperature_uncertainty_95_K", "K", "oil temperature, 95 %", instruments.temperature_K);
}

/// Data-sheet values of the oil; as describe_instruments.
template <class Fluid, class Visitor>
void describe_fluid(Fluid& fluid, Visitor&& visitor) {
  const auto number = [&](const char* key, const char* unit, const char* meaning, auto& value) {
    visitor.number({.key = key, .unit = unit, .limits = {1e-12, 1e12}, .meaning = meaning}, value);
  };
  number("density_15C_kg_per_m3", "kg/m3", "density at 15 degrees Celsius", fluid.density_15C_kg_per_m3);
  number("viscosity_40C_m2_per_s", "m2/s", "kinematic viscosity at 40 degrees Celsius", fluid.viscosity_40C_m2_per_s);
  number("viscosity_100C_m2_per_s", "m2/s", "kinematic viscosity at 100 degrees Celsius",
         fluid.viscosity_100C_m2_per_s);
}

}  // namespace spoolflow::model
