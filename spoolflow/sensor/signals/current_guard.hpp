#pragma once
/// A coil current that leaps as the coil's equation allows none is a fault of its measurement, not of the coil.
#include "spoolflow/sensor/basis/compiler.hpp"
#include "spoolflow/sensor/basis/scalar.hpp"

namespace spoolflow::sensor {

/// The last credible current stands in for so many implausible ones in a row; what lasts longer is accepted.
inline constexpr int most_held_currents = 2;

/// How the coil current changes at most between two samples.
template <class T>
struct CurrentLimits {
  T jump_A{};         ///< at once: eddy currents and noise; 0: not known, no sample is refused
  T slope_A_per_s{};  ///< and with the time since the last sample: voltage over incremental inductance
};

/// A coil's current at the sample before, as it was used, and at this one [A].
template <class T>
struct CurrentStep {
  T before_A;
  T now_A;
};

/// A change beyond `jump_A` is asked about where it is more than this share of the fastest.
inline constexpr double questioned_change_share = 0.25;

/// Whether the last current stands in for this one, where it did in `held` samples in a row before: it leapt as the
/// coil's equation allows none. `possible_A(fastest_A)`, which is asked where the change is a considerable one: by how
/// much the current may have changed beside eddy currents and noise, where any voltage makes it change by `fastest_A`
/// at most.
template <class T, class Possible>
SPOOLFLOW_INLINE constexpr bool is_held(const CurrentLimits<T>& limits, const CurrentStep<T>& current, T time_step_s,
                                        int held, const Possible& possible_A) {
  const T change_A = magnitude(current.now_A - current.before_A);
  if (likely(!(change_A > limits.jump_A))) return false;
  const T beyond_A = change_A - limits.jump_A, fastest_A = limits.slope_A_per_s * time_step_s;
  return beyond_A > T(questioned_change_share) * fastest_A && limits.jump_A > T(0) && held < most_held_currents &&
         beyond_A > possible_A(fastest_A);
}

/// Samples in a row in which the last current stood in, this one included.
constexpr int held_in_a_row(int before, bool held) {
  return held ? before + 1 : 0;
}

}  // namespace spoolflow::sensor
