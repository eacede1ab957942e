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

/// An operating recording and the meter beside it.
struct OperatingRun {
  const recording::Recording* recording;
  numerics::MeterLag meter;
};

/// A flow and its band [m3/s].
struct Shown {
  double flow, lower, upper;
};

struct ReplayedSample {
  const sensor::ObserverState<double>& state;  ///< after the sample
  double time_s;
  double position_m;
  double reference_m3_per_s;  ///< what the meter shows of this sample, its dead time taken out
  Shown shown;                ///< what the meter's lag would make of the answers
};

/// What the meter's lag makes of one answer after the other.
class LaggedAnswer {
 public:
  explicit LaggedAnswer(double lag_s) : lag_s_(lag_s) {}
  const Shown& show(const sensor::Estimate<double>& answer, double time_s) {
    const bool first = std::isnan(shown_.flow);
    const double share = first || !(lag_s_ > 0) ? 1 : numerics::lag_share(time_s - last_s_, lag_s_);
    if (first) shown_ = {0, 0, 0};
    last_s_ = time_s;
    shown_.flow += share * (answer.flow_m3_per_s - shown_.flow);
    shown_.lower += share * (answer.flow_lower_m3_per_s - shown_.lower);
    shown_.upper += share * (answer.flow_upper_m3_per_s - shown_.upper);
    return shown_;
  }

 private:
  double lag_s_;
  double last_s_ = 0;
  Shown shown_{std::nan(""), 0, 0};
};

/// Calls `each(ReplayedSample)` after every sample that has a reference.
template <class Each>
void replay(const sensor::ObserverParameters<double>& parameters, const std::vector<OperatingRun>& runs, Each&& each) {
  using recording::Channel;
  for (const OperatingRun& run : runs) {
    const recording::Recording* recording = run.recording;
    const numerics::MeterLag meter = run.meter;
    const auto reference_m3_per_s = (*recording)[Channel::flow_reference];
    const estimation::Columns all{.time_s = (*recording)[Channel::time],
                                  .current_A = (*recording)[Channel::current],
                                  .voltage_V = recording->column(Channel::voltage),
                                  .position_m = (*recording)[Channel::position],
                                  .oil_temperature_K = recording->column(Channel::oil_temperature)};
    const estimation::Columns used = all.first(std::min(all.size(), operation_samples / runs.size()));
    constexpr double rated_flow_m3_per_s = 0;  // told before the first complete sample only, which nobody looks at
    estimation::RunningSensor sensor(&parameters, rated_flow_m3_per_s);
    LaggedAnswer lagged(meter.lag_s);
    std::size_t late = 0;
    estimation::run(sensor, used, [&](std::size_t k, const sensor::Estimate<double>& told) {
      const Shown& shown = lagged.show(told, used.time_s[k]);
      late = std::max(late, k);
      while (late + 1 < used.size() && used.time_s[late] < used.time_s[k] + meter.dead_time_s) ++late;
      if (!std::isfinite(reference_m3_per_s[late])) return;
      each(
          ReplayedSample{sensor.state().observer, used.time_s[k], used.position_m[k], reference_m3_per_s[late], shown});
    });
  }
}

/// The recordings with the meters that they show beside the observer with these parameters.
[[nodiscard]] std::vector<OperatingRun> with_meters(const sensor::ObserverParameters<double>& parameters,
                                                    const std::vector<const recording::Recording*>& recordings);

}  // namespace spoolflow::calibration
