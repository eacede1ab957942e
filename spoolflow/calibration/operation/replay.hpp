#pragma once
/// The observer over an operating recording, sample by sample, beside its reference flow.
#include <algorithm>
#include <cmath>
#include <vector>

#include "spoolflow/estimation/columns.hpp"
#include "spoolflow/numerics/meter_lag.hpp"
#include "spoolflow/recording/recording.hpp"

namespace spoolflow::calibration {

/// Samples of all operating recordings together that are used, from the beginning of each.
inline constexpr std::size_t operation_samples = 120'000;

/// Of a whole valve, which direction of flow an operating recording shows. `one` is that whose parameters are searched;
/// for both it is P to B.
enum class RunOf { one, other, both };

/// An operating recording and the meter beside it.
struct OperatingRun {
  const recording::Recording* recording;
  numerics::MeterLag meter{};
  RunOf of = RunOf::one;
  sensor::ObserverParameters<double>* other = nullptr;  ///< of a whole valve's other direction; see share_operation
};

/// What operation shows is of one spool, its friction and its position sensor: both directions of a whole valve have it
/// alike, but for friction over that on their benches.
void share_operation(const sensor::ObserverParameters<double>& from, sensor::ObserverParameters<double>& to);

/// A flow and its band [m3/s].
struct Shown {
  double flow, lower, upper;
};

/// In the signs of the direction on whose side the spool stands.
struct ReplayedSample {
  const sensor::ObserverParameters<double>& valve;  ///< of that direction
  const sensor::ObserverState<double>& state;       ///< after the sample
  double time_s;
  double position_m;
  double reference_m3_per_s;  ///< what the meter shows of this sample, its dead time taken out
  Shown shown;                ///< what the meter's lag would make of the answers
  double shown_conductance;   ///< the same of the edge's [m3/s/Pa(1/2)]
};

/// What the meter's lag makes of one answer after the other.
class LaggedAnswer {
 public:
  explicit LaggedAnswer(double lag_s) : share_of_(lag_s) {}
  const Shown& show(const sensor::Estimate<double>& answer, double time_s) {
    const bool first = std::isnan(shown_.flow);
    const double share = first ? 1 : share_of_(time_s - last_s_);
    if (first) shown_ = {0, 0, 0};
    if (answer.pressure_difference_Pa > 0) {
      const double conductance = answer.flow_m3_per_s / std::sqrt(answer.pressure_difference_Pa);
      conductance_ += share * (conductance - conductance_);
    }
    last_s_ = time_s;
    shown_.flow += share * (answer.flow_m3_per_s - shown_.flow);
    shown_.lower += share * (answer.flow_lower_m3_per_s - shown_.lower);
    shown_.upper += share * (answer.flow_upper_m3_per_s - shown_.upper);
    return shown_;
  }
  [[nodiscard]] double conductance() const { return conductance_; }

 private:
  numerics::LagShare share_of_;
  double last_s_ = 0;
  Shown shown_{std::nan(""), 0, 0};
  double conductance_ = 0;
};

/// What the sensor reads of an operating recording.
[[nodiscard]] estimation::Columns operating_columns(const recording::Recording& recording);
/// The sensor for it.
[[nodiscard]] estimation::RunningSensor operating_sensor(const sensor::ObserverParameters<double>& parameters,
                                                         const OperatingRun& run);
/// Calls `each(ReplayedSample)` after every sample that has a reference. What the search turned in `parameters` is
/// taken over by the other direction of a whole valve first.
template <class Each>
void replay(const sensor::ObserverParameters<double>& parameters, const std::vector<OperatingRun>& runs, Each&& each) {
  using recording::Channel;
  for (const OperatingRun& run : runs) {
    if (run.other != nullptr) share_operation(parameters, *run.other);
    const recording::Recording* recording = run.recording;
    const numerics::MeterLag meter = run.meter;
    const auto reference_m3_per_s = (*recording)[Channel::flow_reference];
    const estimation::Columns all = operating_columns(*recording);
    const estimation::Columns used = all.first(std::min(all.size(), operation_samples / runs.size()));
    estimation::RunningSensor sensor = operating_sensor(parameters, run);
    LaggedAnswer lagged(meter.lag_s);
    std::size_t late = 0;
    estimation::run(sensor, used, [&](std::size_t k, const sensor::Estimate<double>& estimate) {
      const Shown& shown = lagged.show(estimate, used.time_s[k]);
      late = std::max(late, k);
      while (late + 1 < used.size() && used.time_s[late] < used.time_s[k] + meter.dead_time_s) ++late;
      if (!std::isfinite(reference_m3_per_s[late])) return;
      const estimation::RunningState& state = sensor.state();
      const bool both = run.of == RunOf::both;
      const bool is_other = run.of == RunOf::other || (both && state.whole_valve.opens_a);
      const double sign = both && is_other ? -1 : 1;
      each(ReplayedSample{is_other ? *run.other : parameters, both ? state.whole_valve.open : state.observer,
                          used.time_s[k], sign * used.position_m[k], sign * reference_m3_per_s[late],
                          sign > 0 ? shown : Shown{-shown.flow, -shown.upper, -shown.lower},
                          sign * lagged.conductance()});
    });
  }
}

/// The runs with the meters that they show: beside the flow that the metering edge passes at the measured pressure
/// difference, or where that was not recorded beside the observer with these parameters.
[[nodiscard]] std::vector<OperatingRun> with_meters(const sensor::ObserverParameters<double>& parameters,
                                                    std::vector<OperatingRun> runs);

}  // namespace spoolflow::calibration
