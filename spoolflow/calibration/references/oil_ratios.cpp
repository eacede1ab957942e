#include "spoolflow/calibration/references/oil_ratios.hpp"

#include <algorithm>
#include <cmath>

#include "spoolflow/numerics/median.hpp"

namespace spoolflow::calibration {
namespace {

constexpr double reference_freedom = sensor::ReferencePriors::freedom;
constexpr int rounds = 20;
constexpr double per_median_distance = 1.4826;  // standard deviation of a normal

/// Of a residual in a weighted sum of squares that has the same slope.
double weight_of(double deviations) {
  return (reference_freedom + 1) / (reference_freedom + deviations * deviations);
}

std::vector<OilRatio> used_of(const std::vector<OilRatio>& ratios, std::size_t reference) {
  std::vector<OilRatio> out;
  for (const OilRatio& each : ratios)
    if (each.used && each.reference == reference) out.push_back(each);
  return out;
}

double median_of(const std::vector<OilRatio>& ratios) {
  std::vector<double> values;
  for (const OilRatio& each : ratios) values.push_back(each.log_ratio);
  return numerics::median(std::move(values));
}

/// log ratio = level - leak * seconds_per_m3, by weighted squares again and again; the leak stays 0 where not asked
/// for.
struct Line {
  double level, leak, loss;
  double level_variance, leak_variance;
};

double residual(const OilRatio& each, const Line& line) {
  return (each.log_ratio - line.level + line.leak * each.seconds_per_m3) / each.deviation;
}

Line line_through(const std::vector<OilRatio>& ratios, bool with_leak) {
  Line out{median_of(ratios), 0, 0, 0, 0};
  double scale2 = 1;
  for (int round = 0; round < rounds; ++round) {
    double sum = 0, x = 0, y = 0, xx = 0, xy = 0, squares = 0;
    for (const OilRatio& each : ratios) {
      const double off = residual(each, out), weight = weight_of(off) / (each.deviation * each.deviation);
      sum += weight;
      x += weight * each.seconds_per_m3;
      y += weight * each.log_ratio;
      xx += weight * each.seconds_per_m3 * each.seconds_per_m3;
      xy += weight * each.seconds_per_m3 * each.log_ratio;
      squares += weight_of(off) * off * off;
    }
    const double spread = xx - x * x / sum;
    const bool leaks = with_leak && spread > 1e-9 * xx;
    out.leak = leaks ? -(xy - x * y / sum) / spread : 0;
    out.level = (y + out.leak * x) / sum;
    scale2 = std::max(1.0, squares / static_cast<double>(ratios.size()));
    out.level_variance = scale2 / sum;
    out.leak_variance = leaks ? scale2 / spread : 0;
  }
  for (const OilRatio& each : ratios) out.loss += interval_loss(residual(each, out));
  return out;
}

/// Loss of so many residuals where the deviations expected of them are the least: all may be larger by one factor, and
/// the likeliest counts. Of normal residuals it is the profile of their likelihood over that factor.
double with_unknown_scale(double loss, std::size_t count) {
  const double expected = 0.5 * static_cast<double>(count);
  return loss > expected ? expected * (1 + std::log(loss / expected)) : loss;
}

}  // namespace

std::vector<OilRatio> oil_ratios(const std::vector<PassedOil>& oil, const std::vector<double>& sensor_m3,
                                 double rated_flow_m3_per_s) {
  std::vector<OilRatio> out;
  for (std::size_t k = 0; k < oil.size(); ++k) {
    const double volume_m3 = oil[k].volume_m3, seconds_per_m3 = (oil[k].end_s - oil[k].begin_s) / volume_m3;
    const bool used = sensor_m3[k] > least_seen_share * volume_m3 && volume_m3 > least_seen_share * sensor_m3[k];
    const double deviation =
        std::hypot(oil[k].uncertainty_m3 / volume_m3, sensor::ReferencePriors::volume_chance_share,
                   sensor::ReferencePriors::volume_chance_flow_share * rated_flow_m3_per_s * seconds_per_m3);
    out.push_back({oil[k].reference, used ? std::log(volume_m3 / sensor_m3[k]) : 0, deviation, seconds_per_m3, used,
                   sensor_m3[k] / volume_m3});
  }
  return out;
}

double interval_loss(double deviations) {
  return 0.5 * (reference_freedom + 1) * std::log1p(deviations * deviations / reference_freedom);
}

OilLevel level_of(const std::vector<OilRatio>& ratios, std::size_t reference) {
  const std::vector<OilRatio> used = used_of(ratios, reference);
  if (used.empty()) return {0, 0, 0, 0};
  const Line line = line_through(used, false);
  return {line.level, std::sqrt(line.level_variance), with_unknown_scale(line.loss, used.size()), used.size()};
}

OilLeak leak_of(const std::vector<OilRatio>& ratios, std::size_t reference) {
  const std::vector<OilRatio> used = used_of(ratios, reference);
  constexpr std::size_t least_intervals = 4;
  if (used.size() < least_intervals) return {0, 0, 0};
  const Line line = line_through(used, true);
  return {line.leak, std::sqrt(line.leak_variance), line_through(used, false).loss - line.loss};
}

void leave_out_apart(std::vector<OilRatio>& ratios) {
  constexpr double least = sensor::ReferencePriors::least_apart_share,
                   times = sensor::ReferencePriors::apart_deviations;
  std::size_t references = 0;
  for (const OilRatio& each : ratios) references = std::max(references, each.reference + 1);
  for (std::size_t r = 0; r < references; ++r) {
    const std::vector<OilRatio> used = used_of(ratios, r);
    if (used.empty()) continue;
    const double middle = median_of(used);
    std::vector<double> distances;
    for (const OilRatio& each : used) distances.push_back(std::abs(each.log_ratio - middle));
    const double most = std::max(least, times * per_median_distance * numerics::median(std::move(distances)));
    for (OilRatio& each : ratios)
      each.used = each.used && (each.reference != r || std::abs(each.log_ratio - middle) <= most);
  }
}

}  // namespace spoolflow::calibration
