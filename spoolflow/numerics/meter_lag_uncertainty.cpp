#include "spoolflow/numerics/meter_lag_uncertainty.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "spoolflow/numerics/median.hpp"

namespace spoolflow::numerics {
namespace {

constexpr double change_over_s = 0.1;  // what find_meter_lag() compares
constexpr double block_s = 1.0;
constexpr std::size_t least_blocks = 10;
constexpr double derivative_s = 0.002;        // half the width over which the shown flow's rate is taken
constexpr double dead_resolution_s = 2.5e-4;  // of the search
constexpr double lag_resolution = 0.0125;     // likewise, as a share of the lag

/// What the errors' scatter does not show, from 22 runs of four valves of the rig, whose meter lags by 30 ms without
/// dead time: the flow is estimated a little early or late, and a lag that smooths the flow's own errors looks better
/// than it is, the more so the larger the share of the reference's changes that stays unexplained.
constexpr double flow_timing_s = 0.002;  // standard uncertainty
constexpr double smoothing = 0.6;        // standard uncertainty over lag and unexplained share

/// Symmetric, of two rows.
struct Matrix {
  double dead = 0, both = 0, lag = 0;

  void add(double weight, double of_dead, double of_lag) {
    dead += weight * of_dead * of_dead, both += weight * of_dead * of_lag, lag += weight * of_lag * of_lag;
  }
  [[nodiscard]] double determinant() const { return dead * lag - both * both; }
};

/// What the meter shows, and how that changes with its dead time and with its lag.
struct Sensitivity {
  std::vector<double> shown, to_dead_time, to_lag;
};

Sensitivity sensitivity_of(std::span<const double> time_s, std::span<const double> flow, const MeterLag& meter) {
  Sensitivity out;
  out.shown.assign(flow.begin(), flow.end());
  apply_lag<double>(time_s, out.shown, meter);
  const std::size_t count = time_s.size();
  out.to_dead_time.assign(count, 0.0);
  std::size_t before = 0, after = 0;
  for (std::size_t k = 0; k < count; ++k) {
    while (time_s[k] - time_s[before] > derivative_s) ++before;
    after = std::max(after, k);
    while (after + 1 < count && time_s[after] - time_s[k] < derivative_s) ++after;
    const double width_s = time_s[after] - time_s[before];
    if (width_s > 0) out.to_dead_time[k] = -(out.shown[after] - out.shown[before]) / width_s;
  }
  // T y' = u - y, so that dy/dT obeys the same lag, driven by -y'.
  out.to_lag = out.to_dead_time;
  apply_lag<double>(time_s, out.to_lag, {.lag_s = meter.lag_s});
  return out;
}

/// Changes over a tenth of a second, as far as both ends are there.
struct Changes {
  std::vector<double> time_s, error, to_dead_time, to_lag;
  double unexplained = 0, of_reference = 0;  ///< sums of sizes
};

Changes changes_of(std::span<const double> time_s, std::span<const double> reference, const Sensitivity& of) {
  Changes out;
  std::size_t b = 0;
  for (std::size_t k = 0; k < time_s.size(); ++k) {
    while (time_s[k] - time_s[b] > change_over_s) ++b;
    const double error = (reference[k] - of.shown[k]) - (reference[b] - of.shown[b]);
    const double to_dead_time = of.to_dead_time[k] - of.to_dead_time[b], to_lag = of.to_lag[k] - of.to_lag[b];
    if (b == k || !std::isfinite(error + to_dead_time + to_lag)) continue;
    out.unexplained += std::abs(error), out.of_reference += std::abs(reference[k] - reference[b]);
    out.time_s.push_back(time_s[k]);
    out.error.push_back(error);
    out.to_dead_time.push_back(to_dead_time);
    out.to_lag.push_back(to_lag);
  }
  return out;
}

}  // namespace

std::optional<MeterLag> meter_lag_uncertainty(std::span<const double> time_s, std::span<const double> flow,
                                              std::span<const double> reference, const MeterLag& found) {
  if (!(found.lag_s > 0 || found.dead_time_s > 0)) return std::nullopt;
  const Changes changes = changes_of(time_s, reference, sensitivity_of(time_s, flow, found));
  // Where the flow moves, the errors are larger than at rest: those weigh by how much the lag shows in them.
  std::vector<double> sizes;
  double largest = 0;
  for (std::size_t k = 0; k < changes.error.size(); ++k) largest = std::max(largest, std::abs(changes.to_lag[k]));
  for (std::size_t k = 0; k < changes.error.size(); ++k) {
    constexpr double relevant = 0.05;
    if (std::abs(changes.to_lag[k]) > relevant * largest) sizes.push_back(std::abs(changes.error[k]));
  }
  if (sizes.empty()) return std::nullopt;
  const double near = median(std::move(sizes));
  if (!(near > 0)) return std::nullopt;
  Matrix curvature, scatter;
  std::array<double, 2> score{0, 0};
  std::size_t blocks = 0;
  double block_end_s = -std::numeric_limits<double>::infinity();
  const auto close_block = [&] {
    if (score[0] != 0 || score[1] != 0) ++blocks;
    scatter.add(1, score[0], score[1]);
    score = {0, 0};
  };
  for (std::size_t k = 0; k < changes.error.size(); ++k) {
    if (changes.time_s[k] >= block_end_s) {
      close_block();
      block_end_s = changes.time_s[k] + block_s;
    }
    const double sign = changes.error[k] > 0 ? 1 : -1;
    score[0] += sign * changes.to_dead_time[k], score[1] += sign * changes.to_lag[k];
    if (std::abs(changes.error[k]) < near) curvature.add(1 / near, changes.to_dead_time[k], changes.to_lag[k]);
  }
  close_block();
  const double determinant = curvature.determinant();
  if (blocks < least_blocks || !(determinant > 1e-9 * curvature.dead * curvature.lag)) return std::nullopt;
  // Covariance: inverse curvature, scatter, inverse curvature.
  const std::array<double, 2> dead{curvature.lag / determinant, -curvature.both / determinant};
  const std::array<double, 2> lag{-curvature.both / determinant, curvature.dead / determinant};
  const auto variance = [&](const std::array<double, 2>& row) {
    return row[0] * row[0] * scatter.dead + 2 * row[0] * row[1] * scatter.both + row[1] * row[1] * scatter.lag;
  };
  const double step_s = (time_s.back() - time_s.front()) / static_cast<double>(time_s.size() - 1);
  const double dead_resolved_s = std::max(step_s, dead_resolution_s) / 2, lag_resolved_s = lag_resolution * found.lag_s;
  // Student's t for 95 %, to within 2 % from 8 degrees of freedom on.
  const double factor = 1.96 + 2.6 / static_cast<double>(blocks - 2);
  const double smoothed_s = smoothing * found.lag_s * changes.unexplained / changes.of_reference;
  const auto half_width = [factor](double of, double resolved_s, double systematic_s) {
    return factor *
           std::sqrt(of + resolved_s * resolved_s / 3 + systematic_s * systematic_s + flow_timing_s * flow_timing_s);
  };
  return MeterLag{half_width(variance(dead), dead_resolved_s, 0),
                  half_width(variance(lag), lag_resolved_s, smoothed_s)};
}

}  // namespace spoolflow::numerics
