#include "spoolflow/rig/bench/series_tolerances.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "spoolflow/rig/numerics/elementary_functions.hpp"

namespace spoolflow::rig {
namespace {

/// Of the spring that closes the spool, the mean over its stroke [N].
double mean_closing_N(const PlantParameters& plant) {
  return plant.spring_b.preload_N + 0.5 * plant.spring_b.rate_N_per_m * plant.spool.stroke_m;
}

}  // namespace

std::string tolerances_text(const ValveUnderTest& valve) {
  const ManufacturingSpread& spread = valve.spread;
  const double amount = spread.amount > 0 ? spread.amount : 1;
  constexpr double um_per_m = 1e6;
  std::string text =
      "\n# How units of the series differ: one standard deviation, for calibrate --as-type.\n[tolerances]\n";
  const auto state = [&](const char* key, double deviation) {
    if (deviation > 0) text += fmt::format("{} = {:.3g}\n", key, amount * deviation);
  };
  state("coercivity", spread.coercive_field);
  state("resistance", spread.coil_resistance);
  state("spring_preload", spread.spring_preload * valve.plant.spring_b.preload_N / mean_closing_N(valve.plant));
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
