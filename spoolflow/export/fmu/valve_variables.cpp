#include "spoolflow/export/fmu/valve_variables.hpp"

namespace spoolflow::exports::fmu {
namespace {

Variable tunable(const char* name, const char* description, const char* unit, const char* display_unit, double start,
                 double lowest, double highest) {
  return {.name = name,
          .description = description,
          .causality = Causality::parameter,
          .variability = Variability::tunable,
          .unit = unit,
          .display_unit = display_unit,
          .start = start,
          .lowest = lowest,
          .highest = highest};
}

/// A true value whose integral over time is the output at the place `of`.
Variable derivative(const char* name, const char* description, const char* unit, double nominal, ValveReference of) {
  Variable out = output(name, description, unit, "", nominal);
  out.derivative_of = static_cast<int>(of);
  return out;
}

/// A set position further than so many strokes is a mistake in its unit.
constexpr double furthest_set = 1.5;

/// Beyond these the plant's laws have no answer.
Variable within(double lowest, double highest, Variable input) {
  input.lowest = lowest;
  input.highest = highest;
  return input;
}
Variable pressure(const char* name, const char* description, double start_Pa) {
  return within(0, 600e5, input(name, description, "Pa", "bar", start_Pa, start_Pa));
}
Variable temperature(const char* name, const char* description, double start_K) {
  return within(233.15, 423.15, input(name, description, "K", "degC", start_K, 300));
}

}  // namespace

std::vector<Variable> valve_variables(const VirtualValve& valve, double rated_flow_m3_per_s) {
  const double stroke_m = valve.plant.spool.stroke_m;
  return {
      {.name = "time", .description = "simulation time", .causality = Causality::independent, .unit = "s"},
      within(-furthest_set * stroke_m, furthest_set * stroke_m,
             input("position_set", "set position of the spool, > 0 opens P to B, < 0 opens P to A", "m", "mm", 0,
                   stroke_m)),
      pressure("pressure_difference_set", "difference that the bench holds over the open edge (load: held difference)",
               5e6),
      pressure("supply_pressure", "set pressure of the supply, gauge (loads: orifice, cylinder, motor)", 1e7),
      within(-1e6, 1e6,
             input("load_force", "force on the cylinder, > 0 against moving out (load: cylinder)", "N", "", 0, 1000)),
      temperature("oil_temperature_set", "temperature of the oil at the supply", 323.15),
      temperature("ambient_temperature", "temperature of the surroundings", 298.15),
      output("current", "measured coil current, mean over the sample step; of solenoid a negative", "A", "", 1),
      output("voltage", "measured coil voltage, mean over the sample step; of solenoid a negative", "V", "", 10),
      output("position", "position as the valve's sensor gives it, with drift, noise and faults", "m", "mm", stroke_m),
      output("oil_temperature", "measured temperature of the oil", "K", "degC", 300),
      output("flow", "true flow rate through the edge that the spool opens, P to B > 0, P to A < 0", "m3/s", "L/min",
             rated_flow_m3_per_s),
      output("pressure_difference", "true pressure difference over that edge", "Pa", "bar", 5e6),
      output("true_position", "true position of the spool", "m", "mm", stroke_m),
      output("magnetic_force", "true magnetic force, towards P to B > 0", "N", "", 50),
      output("flow_force", "true flow force of all edges, steady and transient, closing P to B > 0", "N", "", 50),
      output("friction_force", "true friction of spool and armatures, sign of the velocity", "N", "", 5),
      output("pressure_P", "pressure at port P, gauge", "Pa", "bar", 1e7),
      output("pressure_A", "pressure at port A, gauge", "Pa", "bar", 1e7),
      output("pressure_B", "pressure at port B, gauge", "Pa", "bar", 1e7),
      output("cylinder_position", "position of the cylinder (load: cylinder)", "m", "mm", 0.1),
      {.name = "sample_step",
       .description = "time between values of the outputs, a multiple of 0.1 ms; the valve itself steps every 0.1 ms",
       .causality = Causality::parameter,
       .variability = Variability::fixed,
       .unit = "s",
       .display_unit = "ms",
       .start = 1e-3,
       .lowest = 1e-4,
       .highest = 1e-1,
       .nominal = 1e-3},
      {.name = "seed",
       .description = "of the instruments' noise and faults",
       .causality = Causality::parameter,
       .variability = Variability::fixed,
       .type = Type::integer,
       .start = 1,
       .lowest = 0,
       .highest = 2147483647},
      tunable("dither.amplitude", "dither on the set current", "A", "", valve.electronics.dither.amplitude_A, 0, 1),
      tunable("dither.frequency", "frequency of the dither", "Hz", "", valve.electronics.dither.frequency_Hz, 20, 500),
      tunable("supply.ripple", "amplitude of the pump's ripple", "Pa", "bar", valve.plant.supply.ripple_Pa, 0, 20e5),
      output("current_a", "measured current of the coil that opens P to A, mean over the sample step", "A", "", 1),
      output("current_b", "measured current of the coil that opens P to B, mean over the sample step", "A", "", 1),
      output("voltage_a", "measured voltage of the coil that opens P to A, mean over the sample step", "V", "", 10),
      output("voltage_b", "measured voltage of the coil that opens P to B, mean over the sample step", "V", "", 10),
      derivative("true_velocity", "true velocity of the spool", "m/s", 0.1, valve_true_position),
      derivative("true_acceleration", "true acceleration of the spool", "m/s2", 100, valve_true_velocity),
      derivative("cylinder_velocity", "velocity of the cylinder (load: cylinder)", "m/s", 0.1,
                 valve_cylinder_position)};
}

}  // namespace spoolflow::exports::fmu
