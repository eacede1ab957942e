#include "spoolflow/calibration/references/sensor_view.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "spoolflow/calibration/operation/replay.hpp"
#include "spoolflow/calibration/references/oil_ratios.hpp"
#include "spoolflow/numerics/median.hpp"
#include "spoolflow/sensor/observer.hpp"

namespace spoolflow::calibration {
namespace {

/// Break-aways of a sensor that has just begun show its first guess.
constexpr double settling_s = 10;
/// Before the end of an interval its piston may stand already, and oil beat between valve and cylinder [s].
constexpr double before_end_s = 0.05;

/// Sums over one run.
class RunView {
 public:
  explicit RunView(const WatchedRun& run) : run_(run), volume_m3_(run.oil.size(), 0) {
    for (std::size_t k = 0; k < run.oil.size(); ++k) order_.push_back(k);
    std::ranges::sort(order_, {}, [&](std::size_t k) { return run.oil[k].begin_s; });
  }
  void add(double from_s, double to_s, double flow_m3_per_s) {
    while (first_ < order_.size() && oil(first_).end_s <= from_s) ++first_;
    for (std::size_t k = first_; k < order_.size() && oil(k).begin_s < to_s; ++k) {
      const double seconds = std::min(to_s, oil(k).end_s) - std::max(from_s, oil(k).begin_s);
      if (seconds > 0) volume_m3_[order_[k]] += seconds * flow_m3_per_s;
    }
  }
  /// Whether oil passes by what the machine knows; where it knows nothing of the run, oil may pass at any time.
  [[nodiscard]] bool oil_passes(double at_s) const {
    if (order_.empty()) return true;
    for (std::size_t k = first_; k < order_.size() && oil(k).begin_s <= at_s; ++k)
      if (at_s <= oil(k).end_s - before_end_s) return true;
    return false;
  }
  [[nodiscard]] const std::vector<double>& volume_m3() const { return volume_m3_; }

 private:
  [[nodiscard]] const PassedOil& oil(std::size_t k) const { return run_.oil[order_[k]]; }
  const WatchedRun& run_;
  std::vector<double> volume_m3_;
  std::vector<std::size_t> order_;  ///< of intervals, by their begin
  std::size_t first_ = 0;           ///< that is not over
};

/// Break-aways of the spool: at rest nothing else takes from the variance of the pressure difference.
class BreakAways {
 public:
  /// Of the sample that came `step_s` after the last; nothing where the spool does not break away.
  std::optional<double> next_loss(const sensor::ObserverParameters<double>& valve,
                                  const sensor::ObserverState<double>& state, bool rests, double step_s) {
    sensor::PressureState<double> prior = std::exchange(pressure_, state.pressure);
    const double rested_s = std::exchange(rest_s_, state.friction.rest_s);
    if (!rests) return {};
    const sensor::EdgePoint<double> edge =
        valve.edge.at(state.oil.temperature_K, prior.pressure_difference_Pa, state.position.last_m);
    const double direction = state.friction.smooth_m > state.friction.followed_m ? 1 : -1,  // as it left its rest
        friction_N_per_Pa = ageing(valve.friction, rested_s) * prior.friction_ratio * edge.friction_per_pressure_N_Pa;
    sensor::drift_unobserved(valve.pressure, prior, step_s, valve.highest_pressure_difference_Pa());
    return breakaway_loss(
        prior, state.pressure,
        sensor::whole_slope_N_per_Pa(edge.flow_force_per_pressure_N_Pa, direction * friction_N_per_Pa));
  }

 private:
  sensor::PressureState<double> pressure_{};
  double rest_s_ = 0;
};

}  // namespace

/// The square of an innovation over its variance is that of the change which it makes over what it takes.
std::optional<double> breakaway_loss(const sensor::PressureState<double>& prior,
                                     const sensor::PressureState<double>& posterior, double slope_N_per_Pa) {
  constexpr double rounding = 1e-6;
  const double taken_Pa2 = prior.variance_Pa2 - posterior.variance_Pa2;
  if (!(taken_Pa2 > rounding * prior.variance_Pa2) || !(slope_N_per_Pa > 0)) return {};
  const double change_Pa = posterior.pressure_difference_Pa - prior.pressure_difference_Pa,
               expected_N = slope_N_per_Pa * prior.variance_Pa2 / std::sqrt(taken_Pa2);
  return interval_loss(change_Pa / std::sqrt(taken_Pa2)) + std::log(expected_N);
}

SensorView view_through(const sensor::ObserverParameters<double>& valve, double rated_flow_m3_per_s,
                        const std::vector<WatchedRun>& runs) {
  SensorView out{{}, 0};
  for (const WatchedRun& run : runs) {
    RunView sums(run);
    BreakAways breakaways;
    estimation::RunningSensor sensor(&valve, rated_flow_m3_per_s);
    const estimation::Columns columns = operating_columns(*run.recording);
    const double begin_s = columns.time_s.front();
    double before_s = begin_s;
    estimation::run(sensor, columns, [&](std::size_t k, const sensor::Estimate<double>& answer) {
      const double now_s = columns.time_s[k], step_s = now_s - before_s;
      if (!(step_s > 0)) return;
      sums.add(before_s, now_s, answer.flow_m3_per_s);
      before_s = now_s;
      const sensor::ObserverState<double>& state = sensor.state().observer;
      const bool rests = sensor::has(answer.status, sensor::Status::spool_at_rest);
      const auto broke_away = breakaways.next_loss(valve, state, rests, step_s);
      if (now_s - begin_s < settling_s || !sums.oil_passes(now_s)) return;
      if (broke_away) out.breakaway_loss += *broke_away;
    });
    out.volume_m3.insert(out.volume_m3.end(), sums.volume_m3().begin(), sums.volume_m3().end());
  }
  return out;
}

std::optional<double> closed_reading_m(const sensor::ObserverParameters<double>& valve,
                                       const recording::Recording& recording) {
  constexpr double without_current = 0.01, least_s = 0.3, comes_to_rest_s = 0.1, near_m = 1e-4;
  const estimation::Columns columns = operating_columns(recording);
  const double closed_m = valve.edge.position_m.first;
  std::vector<double> readings_m;
  double silent_s = 0, stood_s = 0, temperature_K = valve.edge.temperature_K.at(1);
  for (std::size_t k = 1; k < columns.size(); ++k) {
    const double step_s = columns.time_s[k] - columns.time_s[k - 1];
    if (!columns.oil_temperature_K.empty() && std::isfinite(columns.oil_temperature_K[k]))
      temperature_K = columns.oil_temperature_K[k];
    const bool silent = std::abs(columns.current_A[k]) < without_current * valve.largest_current_A;
    silent_s = silent ? silent_s + step_s : 0;
    const double reading_m = sensor::drift_free_m(valve.position_sensor, columns.position_m[k], temperature_K);
    if (silent_s < comes_to_rest_s || !(std::abs(reading_m - closed_m) < near_m)) continue;
    readings_m.push_back(reading_m);
    stood_s += step_s;
  }
  if (stood_s < least_s) return {};
  return numerics::median(std::move(readings_m));
}

}  // namespace spoolflow::calibration
