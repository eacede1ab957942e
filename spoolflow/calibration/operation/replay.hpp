#pragma once
/// The observer over an operating recording, sample by sample, beside its reference flow.
#include <algorithm>
#include <cmath>
#include <vector>

#include "spoolflow/estimation/columns.hpp"
#include "spoolflow/recording/recording.hpp"

namespace spoolflow::calibration {

/// Samples of all operating recordings together that are used, from the beginning of each.
inline constexpr std::size_t operation_samples = 120'000;

struct ReplayedSample {
  const sensor::ObserverState<double>& state;  ///< after the sample
  double time_s;
  double position_m;
  double reference_m3_per_s;
};

/// Calls `each(ReplayedSample)` after every sample that has a reference.
template <class Each>
void replay(const sensor::ObserverParameters<double>& parameters,
            const std::vector<const recording::Recording*>& recordings, Each&& each) {
  using recording::Channel;
  for (const recording::Recording* recording : recordings) {
    const auto reference_m3_per_s = (*recording)[Channel::flow_reference];
    const estimation::Columns all{.time_s = (*recording)[Channel::time],
                                  .current_A = (*recording)[Channel::current],
                                  .voltage_V = recording->column(Channel::voltage),
                                  .position_m = (*recording)[Channel::position],
                                  .oil_temperature_K = recording->column(Channel::oil_temperature)};
    const estimation::Columns used = all.first(std::min(all.size(), operation_samples / recordings.size()));
    constexpr double rated_flow_m3_per_s = 0;  // told before the first complete sample only, which nobody looks at
    estimation::RunningSensor sensor(&parameters, rated_flow_m3_per_s);
    estimation::run(sensor, used, [&](std::size_t k, const sensor::Estimate<double>& /*told*/) {
      if (!std::isfinite(reference_m3_per_s[k])) return;
      each(ReplayedSample{sensor.state().observer, used.time_s[k], used.position_m[k], reference_m3_per_s[k]});
    });
  }
}

}  // namespace spoolflow::calibration
