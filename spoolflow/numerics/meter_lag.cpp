#include "spoolflow/numerics/meter_lag.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <vector>

namespace spoolflow::numerics {
namespace {

constexpr double change_s = 0.1;
/// Where more than this share of the reference's changes stays unexplained, a lag would but smooth the flow's own
/// errors.
constexpr double most_unexplained_share = 0.25;

/// Mean size of the changes of `reference` that those of the metered flow do not explain.
class UnexplainedChanges {
 public:
  UnexplainedChanges(std::span<const double> time_s, std::span<const double> flow, std::span<const double> reference)
      : time_s_(time_s), flow_(flow), reference_(reference) {
    std::size_t before = 0;
    for (std::size_t k = 0; k < time_s.size(); ++k) {
      while (time_s[k] - time_s[before] > change_s) ++before;
      before_.push_back(before);
    }
  }

  double operator()(const MeterLag& meter) {
    shown_.assign(flow_.begin(), flow_.end());
    apply_lag<double>(time_s_, shown_, meter);
    double sum = 0;
    for (std::size_t k = 0; k < shown_.size(); ++k) {
      const std::size_t b = before_[k];
      const double change = (reference_[k] - shown_[k]) - (reference_[b] - shown_[b]);
      if (std::isfinite(change)) sum += std::abs(change);
    }
    return sum;
  }

  /// Of a flow that never changes.
  [[nodiscard]] double of_reference() const {
    double sum = 0;
    for (std::size_t k = 0; k < reference_.size(); ++k) {
      const double change = reference_[k] - reference_[before_[k]];
      if (std::isfinite(change)) sum += std::abs(change);
    }
    return sum;
  }

 private:
  std::span<const double> time_s_, flow_, reference_;
  std::vector<std::size_t> before_;
  std::vector<double> shown_;
};

/// Standard deviation of what the metered flow leaves of `reference`, a gain and an offset taken out.
class UnexplainedLevels {
 public:
  UnexplainedLevels(std::span<const double> time_s, std::span<const double> flow, std::span<const double> reference)
      : time_s_(time_s), flow_(flow), reference_(reference) {}

  double operator()(const MeterLag& meter) {
    shown_.assign(flow_.begin(), flow_.end());
    apply_lag<double>(time_s_, shown_, meter);
    return std::sqrt(std::max(0.0, moments().left()));
  }

  /// Of a flow that never changes.
  [[nodiscard]] double of_reference() {
    shown_.assign(flow_.size(), 0.0);
    return std::sqrt(std::max(0.0, moments().all()));
  }

 private:
  /// Sums over the samples that have both.
  struct Moments {
    double count = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;

    [[nodiscard]] double all() const { return (yy - y * y / count) / count; }
    [[nodiscard]] double left() const {
      const double of_flow = xx - x * x / count, common = xy - x * y / count;
      return of_flow > 0 ? all() - common * common / of_flow / count : all();
    }
  };

  [[nodiscard]] Moments moments() const {
    Moments out;
    for (std::size_t k = 0; k < shown_.size(); ++k) {
      const double x = shown_[k], y = reference_[k];
      if (!std::isfinite(x) || !std::isfinite(y)) continue;
      out.count += 1;
      out.x += x;
      out.y += y;
      out.xx += x * x;
      out.xy += x * y;
      out.yy += y * y;
    }
    return out;
  }

  std::span<const double> time_s_, flow_, reference_;
  std::vector<double> shown_;
};

/// The meter that leaves least unexplained; none where that is too much.
template <class Unexplained>
std::optional<MeterLag> least_unexplained(Unexplained&& unexplained) {
  MeterLag best;
  double least = unexplained(best);
  const auto try_lag = [&](const MeterLag& meter) {
    const double left = unexplained(meter);
    if (left >= least) return false;
    least = left;
    best = meter;
    return true;
  };
  const auto search = [&](std::initializer_list<double> dead_times_s) {
    for (const double dead_time_s : dead_times_s)
      for (const double lag_s : {0.005, 0.01, 0.02, 0.04, 0.08, 0.15, 0.3}) try_lag({dead_time_s, lag_s});
    double dead_step_s = 0.008;
    double factor = 1.4;
    for (int round = 0; round < 6; ++round) {
      while (try_lag({best.dead_time_s, std::min(best.lag_s * factor, 0.5)}) ||
             try_lag({best.dead_time_s, best.lag_s / factor})) {
      }
      while (try_lag({std::min(best.dead_time_s + dead_step_s, 0.5), best.lag_s}) ||
             try_lag({std::max(best.dead_time_s - dead_step_s, 0.0), best.lag_s})) {
      }
      factor = 1 + 0.5 * (factor - 1);
      dead_step_s *= 0.5;
    }
    return least < most_unexplained_share * unexplained.of_reference();
  };
  // A meter itself, or one behind a control or a bus.
  if (search({0.0, 0.01, 0.03}) || search({0.1, 0.2, 0.3, 0.4, 0.5})) return best;
  return std::nullopt;
}

bool has_samples(std::span<const double> flow, std::span<const double> reference, std::size_t least_samples) {
  std::size_t both = 0;
  for (std::size_t k = 0; k < flow.size(); ++k) both += std::isfinite(flow[k]) && std::isfinite(reference[k]) ? 1U : 0U;
  return both >= least_samples;
}

}  // namespace

std::optional<MeterLag> find_meter_lag(std::span<const double> time_s, std::span<const double> flow,
                                       std::span<const double> reference, std::size_t least_samples) {
  if (!has_samples(flow, reference, least_samples)) return std::nullopt;
  return least_unexplained(UnexplainedChanges(time_s, flow, reference));
}

std::optional<MeterLag> find_lag_of_known_flow(std::span<const double> time_s, std::span<const double> flow,
                                               std::span<const double> reference, std::size_t least_samples) {
  if (!has_samples(flow, reference, least_samples)) return std::nullopt;
  return least_unexplained(UnexplainedLevels(time_s, flow, reference));
}

}  // namespace spoolflow::numerics
