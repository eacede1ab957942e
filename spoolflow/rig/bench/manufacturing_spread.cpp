#include "spoolflow/rig/bench/manufacturing_spread.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "spoolflow/rig/numerics/elementary_functions.hpp"
#include "spoolflow/rig/numerics/noise.hpp"

namespace spoolflow::rig {
namespace {

/// Named draws: a figure added later leaves the others of the same seed as they were.
class Draw {
 public:
  Draw(double amount, std::uint64_t seed) : amount_(amount), seed_(seed) {}
  double deviate(std::string_view name, double standard_deviation) const {
    Noise noise(seed_, std::string("spread of ").append(name));
    return amount_ * standard_deviation * std::clamp(noise.normal(), -2.5, 2.5);
  }
  double factor(std::string_view name, double relative) const { return 1 + deviate(name, relative); }
  /// Up to `largest` times more or less, evenly over the logarithm.
  double times_or_over(std::string_view name, double largest) const {
    Noise noise(seed_, std::string("spread of ").append(name));
    return power(largest, amount_ * noise.uniform(-1, 1));
  }

 private:
  double amount_;
  std::uint64_t seed_;
};

/// Of the spring that closes the spool, the mean over its stroke [N].
double mean_closing_N(const PlantParameters& plant) {
  return plant.spring_b.preload_N + 0.5 * plant.spring_b.rate_N_per_m * plant.spool.stroke_m;
}

}  // namespace

void draw(const ManufacturingSpread& spread, std::uint64_t seed, PlantParameters& plant, Lvdt& lvdt) {
  if (spread.amount == 0) {
    return;
  }
  const Draw drawn(spread.amount, seed);
  const double rate = drawn.factor("spring rate", spread.spring_rate);
  for (Spring* spring : {&plant.spring_a, &plant.spring_b}) {
    const bool is_a = spring == &plant.spring_a;
    spring->rate_N_per_m *= rate;  // one batch of wire for the pair
    spring->preload_N *= drawn.factor(is_a ? "preload a" : "preload b", spread.spring_preload);
  }
  plant.spool_friction.base_N *= drawn.factor("spool friction", spread.friction);
  plant.flow_force.friction_per_pressure_N_per_Pa *= drawn.factor("pressure friction", spread.friction);
  plant.flow_force.lateral_friction *= drawn.factor("lateral friction", spread.friction);
  const double ageing_time = drawn.times_or_over("ageing time", spread.ageing_time);
  for (Friction* friction : {&plant.spool_friction, &plant.solenoid_a.friction, &plant.solenoid_b.friction}) {
    friction->ageing_time_s *= ageing_time;  // one oil and one grinding for all three
  }
  plant.spool.clearance_m *= drawn.factor("clearance", spread.clearance);
  const double discharge = drawn.factor("discharge", spread.discharge);
  const auto cut = [&](MeteringEdge& edge, std::string name) {
    edge.notch_width_m *= drawn.factor(name + " width", spread.notch_width);
    edge.overlap_m += drawn.deviate(name + " overlap", spread.overlap_m);
    edge.discharge_coefficient *= discharge;
  };
  cut(plant.edge_PA, "edge PA");
  cut(plant.edge_PB, "edge PB");
  cut(plant.edge_AT, "edge AT");
  cut(plant.edge_BT, "edge BT");
  const auto wind = [&](Solenoid& solenoid, std::string name) {
    solenoid.coil.resistance_20C_ohm *= drawn.factor(name + " resistance", spread.coil_resistance);
    solenoid.circuit.radial_gap_m *= drawn.factor(name + " radial gap", spread.radial_gap);
    solenoid.hysteresis.coercive_field_A_per_m *= drawn.factor(name + " coercive field", spread.coercive_field);
    const double reversible_share = drawn.factor(name + " reversible share", spread.reversible_share);
    solenoid.hysteresis.jiles_atherton.reversible_share *= reversible_share;
    solenoid.hysteresis.preisach.reversible_share *= reversible_share;
    solenoid.iron.saturation_T *= drawn.factor(name + " saturation", spread.saturation);
    solenoid.friction.base_N *= drawn.factor(name + " friction", spread.friction);
  };
  wind(plant.solenoid_a, "solenoid a");
  wind(plant.solenoid_b, "solenoid b");
  lvdt.gain_error += drawn.deviate("sensor gain", spread.sensor_gain);
  lvdt.zero_offset_m += drawn.deviate("sensor zero", spread.sensor_zero_m);
  lvdt.zero_drift_per_K *= drawn.factor("sensor drift", spread.sensor_drift);
  keep_inside_ranges(plant);
  keep_inside_ranges(lvdt);
}

std::string tolerances_text(const ManufacturingSpread& spread, const PlantParameters& nominal) {
  const double amount = spread.amount > 0 ? spread.amount : 1;
  constexpr double um_per_m = 1e6;
  std::string text =
      "\n# How units of the series differ: one standard deviation, for calibrate --as-type.\n[tolerances]\n";
  const auto state = [&](const char* key, double deviation) {
    if (deviation > 0) text += fmt::format("{} = {:.3g}\n", key, amount * deviation);
  };
  state("coercivity", spread.coercive_field);
  state("resistance", spread.coil_resistance);
  state("spring_preload", spread.spring_preload * nominal.spring_b.preload_N / mean_closing_N(nominal));
  state("spring_rate", spread.spring_rate);
  state("edge_position_um", um_per_m * spread.overlap_m);
  state("edge_width", std::hypot(spread.notch_width, spread.discharge));
  for (const char* key : {"spool_friction", "pressure_friction", "armature_friction"}) state(key, spread.friction);
  state("ageing_time", natural_logarithm(spread.ageing_time) / std::numbers::sqrt3);  // drawn evenly over the logarithm
  state("position_zero_um", um_per_m * spread.sensor_zero_m);
  state("position_gain", spread.sensor_gain);
  return text;
}

}  // namespace spoolflow::rig
