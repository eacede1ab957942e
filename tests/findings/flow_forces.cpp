#include "tests/findings/flow_forces.hpp"

#include <algorithm>
#include <cmath>

#include "spoolflow/rig/bench/valve_under_test.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::findings {
namespace {

constexpr double positions_mm[] = {0.4, 0.6, 0.8, 1.0, 1.2, 1.4, 1.6, 1.8, 2.0, 2.2, 2.4};

FlowForceCurve curve(const rig::PlantParameters& plant, double position_mm, double temperature_C) {
  FlowForceCurve out{.position_mm = position_mm, .temperature_C = temperature_C};
  for (double pressure_bar = 5; pressure_bar <= 70; pressure_bar += 1) {
    rig::PlantInput input;
    input.oil_temperature_C = temperature_C;
    input.held_pressure_difference_Pa = units::Pa_from_bar(pressure_bar);
    input.motion = rig::PrescribedMotion{.position_m = units::m_from_mm(position_mm)};
    const rig::PlantOutput at_rest = observe(plant, plant_at_rest(plant, input), input);
    out.pressure_bar.push_back(pressure_bar);
    out.flow_L_min.push_back(units::L_per_min_from_m3_per_s(at_rest.flow_m3_per_s));
    out.force_N.push_back(at_rest.flow_force_N);
  }
  return out;
}

rig::PlantParameters bench() {
  rig::PlantParameters plant = rig::valve_preset("size_6").plant;
  plant.arrangement = rig::Arrangement::axial_force_bench;
  plant.supply.ripple_Pa = 0;
  plant.load.ideal_hold = true;
  return plant;
}

}  // namespace

double FlowForceCurve::force_at(double flow) const {
  const auto above = std::lower_bound(flow_L_min.begin(), flow_L_min.end(), flow);
  if (above == flow_L_min.begin() || above == flow_L_min.end()) return NAN;
  const auto k = static_cast<std::size_t>(above - flow_L_min.begin());
  const double share = (flow - flow_L_min[k - 1]) / (flow_L_min[k] - flow_L_min[k - 1]);
  return force_N[k - 1] + share * (force_N[k] - force_N[k - 1]);
}

std::vector<FlowForceCurve> flow_force_curves(double temperature_C) {
  std::vector<FlowForceCurve> curves;
  for (const double position_mm : positions_mm) curves.push_back(curve(bench(), position_mm, temperature_C));
  return curves;
}

std::vector<TemperatureEffect> temperature_effects() {
  std::vector<TemperatureEffect> effects;
  for (const double position_mm : positions_mm) {
    for (const double flow : {10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0}) {
      TemperatureEffect effect{.position_mm = position_mm, .flow_L_min = flow};
      for (double temperature_C = 30; temperature_C <= 80; temperature_C += 10) {
        effect.temperature_C.push_back(temperature_C);
        effect.force_N.push_back(curve(bench(), position_mm, temperature_C).force_at(flow));
      }
      if (std::none_of(effect.force_N.begin(), effect.force_N.end(), [](double f) { return std::isnan(f); })) {
        effects.push_back(effect);
      }
    }
  }
  return effects;
}

std::vector<Finding> flow_force_findings(const std::vector<FlowForceCurve>& curves,
                                         const std::vector<TemperatureEffect>& effects) {
  const auto [least, most] = std::minmax_element(effects.begin(), effects.end(),
                                                 [](const TemperatureEffect& one, const TemperatureEffect& two) {
                                                   return one.fall_percent() < two.fall_percent();
                                                 });
  double flattest = INFINITY;  // least dF/dQ
  for (const FlowForceCurve& curve : curves) {
    for (std::size_t k = 1; k < curve.force_N.size(); ++k) {
      flattest = std::min(flattest,
                          (curve.force_N[k] - curve.force_N[k - 1]) / (curve.flow_L_min[k] - curve.flow_L_min[k - 1]));
    }
  }
  return {
      {"least fall of the flow force at constant flow, 30 to 80 C", least->fall_percent(), "%", 15, 23, "paper 2.1.1"},
      {"largest fall of the flow force at constant flow, 30 to 80 C", most->fall_percent(), "%", 15, 23, "paper 2.1.1"},
      {"least slope of flow force over flow, 5 to 70 bar: one force, one flow", flattest, "N min/L", 0.01, 10,
       "paper 3"}};
}

}  // namespace spoolflow::findings
