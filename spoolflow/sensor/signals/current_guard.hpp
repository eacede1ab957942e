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

/// Whether the current leapt as the coil's equation allows none. `moved_A`, >= 0: what the spool's motion adds.
template <class T>
SPOOLFLOW_INLINE constexpr bool leaps(const CurrentLimits<T>& limits, const CurrentStep<T>& current, T time_step_s,
                                      T moved_A) {
  return magnitude(current.now_A - current.before_A) > limits.jump_A + limits.slope_A_per_s * time_step_s + moved_A &&
         limits.jump_A > T(0);
}

/// Whether the last current stands in for this one, where it did in `held` samples in a row before. `moved_A()`, which
/// is asked where the spool at rest would not explain the current: by how much its motion may have changed it.
template <class T, class Moved>
SPOOLFLOW_INLINE constexpr bool is_held(const CurrentLimits<T>& limits, const CurrentStep<T>& current, T time_step_s,
                                        int held, const Moved& moved_A) {
  return unlikely(leaps(limits, current, time_step_s, T(0))) && held < most_held_currents &&
         leaps(limits, current, time_step_s, moved_A());
}

/// Samples in a row in which the last current stood in, this one included.
constexpr int held_in_a_row(int before, bool held) {
  return held ? before + 1 : 0;
}

}  // namespace spoolflow::sensor
