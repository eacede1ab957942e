#include "addons/fleet/page/series_spread.hpp"

#include <algorithm>
#include <cmath>

#include "spoolflow/numerics/median.hpp"

namespace spoolflow::fleet {

SeriesSpread spread_of(const std::vector<ValveFigure>& values) {
  std::vector<double> known, uncertain;
  for (const ValveFigure& one : values) {
    if (std::isnan(one.value)) continue;
    known.push_back(one.value);
    uncertain.push_back(one.uncertainty_95);
  }
  SeriesSpread out{.median = numerics::median(known), .valves = known.size()};
  for (double& value : known) value = std::abs(value - out.median);
  constexpr double deviations_per_mad = 1.4826, half_width_95 = 1.96;
  const double own = numerics::median(std::move(uncertain)) / half_width_95;
  out.scale = deviations_per_mad * numerics::median(std::move(known));
  if (own > out.scale) out.scale = own;
  return out;
}

double score(const SeriesSpread& spread, const ValveFigure& one) {
  if (std::isnan(one.value)) return one.value;
  return spread.scale > 0 ? (one.value - spread.median) / spread.scale : 0;
}

bool is_outlier(const SeriesSpread& spread, const ValveFigure& one) {
  if (spread.valves < fewest_sisters || std::isnan(one.value)) return false;
  const bool is_known_well = std::isnan(one.uncertainty_95) || std::abs(one.value - spread.median) > one.uncertainty_95;
  return is_known_well && std::abs(score(spread, one)) > outlier_score;
}

}  // namespace spoolflow::fleet
