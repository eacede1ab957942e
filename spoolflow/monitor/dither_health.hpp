#pragma once
/// What the electronics' dither is: amplitude and frequency found in the coil current, and how far it frees the spool.
#include <algorithm>
#include <cmath>
#include <type_traits>

#include "spoolflow/sensor/signals/dither.hpp"

namespace spoolflow::monitor {

/// Mean over this time [s] with dither.
inline constexpr double dither_memory_s = 10;
/// Known from so much time with dither on [s].
inline constexpr double least_dithered_s = 2;

struct DitherHealth {
  sensor::DitherState<double> current;
  double dithered_s = 0;    ///< in all
  double amplitude_A = 0;   ///< half of peak to peak, mean
  double frequency_Hz = 0;  ///< mean
  double free_share = 0;    ///< of the time with dither in which friction does not hold the spool, mean
  bool follows = false;
};
static_assert(std::is_trivially_copyable_v<DitherHealth>);

struct DitherSample {
  double time_step_s;
  double current_A;  ///< finite
  bool free;         ///< the sensor says that the spool is not at rest
};

inline void interrupt(DitherHealth& health) {
  health.follows = false;
}

/// One sample.
inline void follow(DitherHealth& health, double largest_current_A, const DitherSample& sample) {
  if (!health.follows) sensor::begin(health.current, sample.current_A);
  health.follows = true;
  const sensor::Dither<double> dither =
      sensor::follow_dither(health.current, sample.current_A, largest_current_A, sample.time_step_s);
  if (!dither.present) return;
  health.dithered_s += sample.time_step_s;
  const double pace =
      std::max(sample.time_step_s / dither_memory_s, sample.time_step_s / std::max(health.dithered_s, 1e-9));
  const double kept = std::min(pace, 1.0);
  health.amplitude_A += kept * (sensor::dither_amplitude_A(health.current) - health.amplitude_A);
  health.frequency_Hz += kept * (sensor::dither_frequency_Hz(health.current) - health.frequency_Hz);
  health.free_share += kept * ((sample.free ? 1.0 : 0.0) - health.free_share);
}

}  // namespace spoolflow::monitor
