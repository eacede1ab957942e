#include "spoolflow/export/fmu/sensor_variables.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "spoolflow/export/fmu/sensor_numbers.hpp"

namespace spoolflow::exports::fmu {
namespace {

/// What they mean, their units and limits stand in the model's description.
constexpr std::array<Tunable, 15> tunables{{
    // drift and errors of the position sensor
    {"position_drift_m_per_K", "drift.position_per_temperature", "um/K"},
    {"position_drift_free_K", "drift.free_temperature", "degC"},
    {"coil_resistance_drift_Ohm_per_root_s", "drift.coil_resistance", ""},
    // filter
    {"position_noise_m", "filter.position_noise", "um"},
    {"sliding_drift_Pa_per_sqrt_s", "filter.pressure_drift_sliding", "bar/s(1/2)"},
    {"resting_drift_Pa_per_sqrt_s", "filter.pressure_drift_resting", "bar/s(1/2)"},
    {"constrained_correction_s", "filter.constrained_correction_time", "ms"},
    {"band_coverage_factor", "filter.band_coverage", ""},
    {"force_residual_N", "filter.force_residual", ""},
    {"flow_residual_m3_per_s", "filter.flow_residual", "L/min"},
    {"band_force_residual_N", "filter.band_force_residual", ""},
    {"band_flow_residual_m3_per_s", "filter.band_flow_residual", "L/min"},
    // limits
    {"hardest_acceleration_m_per_s2", "limit.acceleration", ""},
    {"closed_below_m", "limit.closed_below", "mm"},
    {"largest_current_A", "limit.current", ""},
}};

/// Keeps the numbers that a tunable names; passes over everything else.
struct TunableVisitor {
  std::vector<TunableNumber>& found;

  void map(const model::TableParameter&, auto&) {}
  void curve(const model::TableParameter&, auto&) {}
  void volume(const model::TableParameter&, auto&) {}
  void axis(const model::AxisParameter&, auto&, int) {}
  void list(const model::Parameter&, auto&) {}
  void number(const model::Parameter& about, double& value) {
    const auto it =
        std::find_if(tunables.begin(), tunables.end(), [&](const Tunable& each) { return each.key == about.key; });
    if (it != tunables.end()) found.push_back({std::string(it->name), *it, about, &value});
  }
};

Variable tunable_parameter(const TunableNumber& number) {
  return {.name = number.name,
          .description = number.about.meaning,
          .causality = Causality::parameter,
          .variability = Variability::tunable,
          .unit = number.about.unit,
          .display_unit = std::string(number.shown.display_unit),
          .start = *number.value,
          .lowest = number.about.limits.lowest,
          .highest = number.about.limits.highest};
}

std::vector<Variable> sensor_outputs(bool whole, double flow) {
  return {
      output("flow", whole ? "flow rate, P to B > 0, P to A < 0" : "flow rate", "m3/s", "L/min", flow),
      output("flow_lower", "lower end of the 95 % band of the flow rate", "m3/s", "L/min", flow),
      output("flow_upper", "upper end of the 95 % band of the flow rate", "m3/s", "L/min", flow),
      output("pressure_difference", "pressure difference over the metering edge", "Pa", "bar", 5e6),
      output("magnetic_force", whole ? "magnetic force, > 0 opens P to B" : "magnetic force, opening > 0", "N", "", 50),
      output("spring_force", whole ? "spring force, > 0 closes P to B" : "spring force, closing > 0", "N", "", 50),
      output("flow_force", whole ? "steady flow force, > 0 closes P to B" : "steady flow force, closing > 0", "N", "",
             50),
      output("friction_force", "friction of spool and armature, sign of the velocity", "N", "", 5),
      {.name = "status",
       .description = "status bits, 0 when all is well; see the documentation",
       .causality = Causality::output,
       .variability = Variability::discrete,
       .type = Type::integer},
      {.name = "fault",
       .description = "an input or the model cannot be trusted: a bit of status from 65536 on is set",
       .causality = Causality::output,
       .variability = Variability::discrete,
       .type = Type::boolean}};
}

std::vector<Variable> sensor_settings() {
  return {{.name = "sample_step",
           .description = "time between samples of the sensor, whatever the communication step",
           .causality = Causality::parameter,
           .variability = Variability::fixed,
           .unit = "s",
           .display_unit = "ms",
           .start = 1e-3,
           .lowest = 5e-5,
           .highest = 5e-3,
           .nominal = 1e-3},
          flag("use_voltage", "whether the coil voltage is measured"),
          flag("use_oil_temperature", "whether the oil temperature is measured")};
}

}  // namespace

template <class Parameters>
std::vector<TunableNumber> tunable_numbers(Parameters& parameters) {
  std::vector<TunableNumber> found;
  if constexpr (requires { parameters.a; }) {
    found = tunable_numbers(parameters.b);
    for (TunableNumber& number : found) number.name = "b." + number.name;
    for (TunableNumber& number : tunable_numbers(parameters.a)) {
      number.name = "a." + number.name;
      found.push_back(std::move(number));
    }
  } else {
    TunableVisitor visitor{found};
    describe(parameters, visitor);
  }
  return found;
}

template std::vector<TunableNumber> tunable_numbers(BothDirections<sensor::CondensedParameters<double>>& parameters);
template std::vector<TunableNumber> tunable_numbers(BothDirections<sensor::ObserverParameters<double>>& parameters);
template std::vector<TunableNumber> tunable_numbers(sensor::CondensedParameters<double>& parameters);
template std::vector<TunableNumber> tunable_numbers(sensor::ObserverParameters<double>& parameters);

std::vector<Variable> sensor_variables(const SensorScale& scale, const std::vector<TunableNumber>& tunable) {
  std::vector<Variable> all{
      {.name = "time", .description = "simulation time", .causality = Causality::independent, .unit = "s"}};
  const auto add = [&](const std::vector<Variable>& more) { all.insert(all.end(), more.begin(), more.end()); };
  add(sensor_inputs(scale.whole, scale.stroke_m));
  add(sensor_outputs(scale.whole, scale.rated_flow_m3_per_s));
  add(sensor_settings());
  if (scale.whole) add(whole_valve_inputs());
  for (const TunableNumber& number : tunable) all.push_back(tunable_parameter(number));
  return all;
}

}  // namespace spoolflow::exports::fmu
