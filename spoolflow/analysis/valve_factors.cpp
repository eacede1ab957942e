#include "spoolflow/analysis/valve_factors.hpp"

#include <algorithm>

#include "spoolflow/uncertainty/distribution.hpp"

namespace spoolflow::analysis {
namespace {

/// Takes the numbers one after the other, in the order of valve_factors().
class Numbers {
 public:
  explicit Numbers(const std::vector<double>& uniform) : next_(uniform.data()) {}
  double uniform(double from, double to) { return from + (to - from) * *next_++; }
  /// Normal, cut off at 2.5 standard deviations.
  double deviate(double standard_deviation) {
    return standard_deviation * std::clamp(uncertainty::normal_quantile(*next_++), -2.5, 2.5);
  }
  double factor(double percent) { return 1 + 0.01 * deviate(percent); }

 private:
  const double* next_;
};

}  // namespace

const std::vector<Factor>& valve_factors() {
  static const std::vector<Factor> all{
      {"spring", FactorKind::sub_model, 3},
      {"friction", FactorKind::sub_model, 4},
      {"metering edge", FactorKind::sub_model, 6},
      {"solenoid force", FactorKind::sub_model, 3},
      {"magnetic hysteresis", FactorKind::sub_model, 1},
      {"oil temperature", FactorKind::sub_model, 1},
      {"oil data", FactorKind::sub_model, 2},
      {"position sensor", FactorKind::instrument, 3},
      {"current measurement", FactorKind::instrument, 2},
      {"voltage measurement", FactorKind::instrument, 2},
      {"thermometer", FactorKind::instrument, 1},
  };
  return all;
}

DrawnValve drawn_valve(const rig::ValveUnderTest& nominal, const SpreadSettings& spread,
                       const std::vector<double>& uniform) {
  Numbers next(uniform);
  DrawnValve out{nominal, 0};
  rig::PlantParameters& plant = out.valve.plant;

  const double rate = next.factor(spread.spring_rate_percent);
  for (rig::Spring* spring : {&plant.spring_a, &plant.spring_b}) {
    spring->rate_N_per_m *= rate;  // one batch of wire for the pair
    spring->preload_N *= next.factor(spread.spring_preload_percent);
  }

  plant.spool_friction.base_N *= next.factor(spread.friction_percent);
  plant.flow_force.friction_per_pressure_N_per_Pa *= next.factor(spread.friction_percent);
  plant.flow_force.lateral_friction *= next.factor(spread.friction_percent);
  plant.solenoid_b.friction.base_N *= next.factor(spread.friction_percent);

  // P to B and back from A to T: the two edges that are open.
  for (rig::MeteringEdge* edge : {&plant.edge_PB, &plant.edge_AT}) {
    edge->notch_width_m *= next.factor(spread.notch_width_percent);
    edge->overlap_m += next.deviate(1e-6 * spread.overlap_um);
  }
  const double discharge = next.factor(spread.discharge_percent);
  for (rig::MeteringEdge* edge : {&plant.edge_PB, &plant.edge_AT}) edge->discharge_coefficient *= discharge;
  plant.spool.clearance_m *= next.factor(spread.clearance_percent);

  plant.solenoid_b.circuit.radial_gap_m *= next.factor(spread.radial_gap_percent);
  plant.solenoid_b.iron.saturation_T *= next.factor(spread.saturation_percent);
  plant.solenoid_b.coil.resistance_20C_ohm *= next.factor(spread.coil_resistance_percent);

  plant.solenoid_b.hysteresis.coercive_field_A_per_m *= next.factor(spread.coercive_field_percent);

  out.oil_temperature_C = next.uniform(spread.oil_coldest_C, spread.oil_warmest_C);

  plant.oil.density_15C_kg_per_m3 *= next.factor(spread.oil_density_percent);
  const double viscosity = next.factor(spread.oil_viscosity_percent);
  plant.oil.viscosity_40C_m2_per_s *= viscosity;
  plant.oil.viscosity_100C_m2_per_s *= viscosity;

  rig::Instruments& instruments = out.valve.instruments;
  instruments.lvdt.gain_error += 0.01 * next.deviate(spread.position_gain_percent);
  instruments.lvdt.zero_offset_m += next.deviate(1e-6 * spread.position_zero_um);
  instruments.lvdt.zero_drift_per_K *= next.factor(spread.position_drift_percent);
  instruments.shunt.errors.gain_error += 0.01 * next.deviate(spread.current_gain_percent);
  instruments.shunt.errors.offset += next.deviate(1e-3 * spread.current_offset_mA);
  instruments.voltage.errors.gain_error += 0.01 * next.deviate(spread.voltage_gain_percent);
  instruments.voltage.errors.offset += next.deviate(1e-3 * spread.voltage_offset_mV);
  instruments.thermometer.errors.offset += next.deviate(spread.thermometer_K);

  rig::keep_inside_ranges(plant);
  rig::keep_inside_ranges(instruments);
  return out;
}

}  // namespace spoolflow::analysis
