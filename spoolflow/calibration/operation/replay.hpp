#pragma once
/// The observer over an operating recording, sample by sample, beside its reference flow.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "spoolflow/recording/recording.hpp"
#include "spoolflow/sensor/observer.hpp"

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
    const auto time_s = (*recording)[Channel::time];
    const auto current_A = (*recording)[Channel::current];
    const auto position_m = (*recording)[Channel::position];
    const auto reference_m3_per_s = (*recording)[Channel::flow_reference];
    const auto at = [&](Channel channel, std::size_t k) {
      return recording->has(channel) ? (*recording)[channel][k] : std::numeric_limits<double>::quiet_NaN();
    };
    sensor::ObserverState<double> state{};
    double last_s = time_s[0];
    const std::size_t samples = std::min(recording->size(), operation_samples / recordings.size());
    for (std::size_t k = 0; k < samples; ++k) {
      sensor::step(
          parameters, state,
          {time_s[k] - last_s, current_A[k], at(Channel::voltage, k), position_m[k], at(Channel::oil_temperature, k)});
      last_s = time_s[k];
      if (std::isfinite(reference_m3_per_s[k]))
        each(ReplayedSample{state, time_s[k], position_m[k], reference_m3_per_s[k]});
    }
  }
}

}  // namespace spoolflow::calibration
