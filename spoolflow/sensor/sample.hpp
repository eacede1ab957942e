#pragma once
/// What goes into the sensor and what comes out, each sample.
#include "spoolflow/sensor/scalar.hpp"
#include "spoolflow/sensor/status.hpp"

namespace spoolflow::sensor {

/// One sample of what the valve's electronics have. Nothing else ever reaches the sensor.
template <class T>
struct Sample {
  T time_step_s{};  ///< since the sample before, >= 0
  T current_A{};    ///< coil current, mean over the step
  T voltage_V{};    ///< coil voltage, mean over the step
  T position_m{};   ///< spool position, 0 closed, > 0 opens P to B
  T oil_temperature_K{};
};

/// A spool that reads so far beyond half the overlap on the closed side [m] opens the other direction of flow: no zero
/// drifts as far.
inline constexpr double other_direction_m = 50e-6;

/// After a longer time step [s] nothing counts of what was believed before: the sensor begins anew.
inline constexpr int longest_step_s = 1;
/// A time step of so much [s] is none.
inline constexpr int endless_step_s = 1 << 30;

/// While no position tells where the spool is, it may go anywhere: the band of the held answer opens at this pace [s]
/// to all that may flow.
inline constexpr double held_opening_s = 0.3;

/// Whether time leapt between the last sample and this one.
template <class T>
constexpr Mask<T> time_leapt(T time_step_s) {
  return lies_below(T(longest_step_s), time_step_s);
}

/// What nearly always holds: nothing is missing, and time has advanced by an ordinary step.
template <class T>
constexpr bool ordinary(const Sample<T>& sample) {
  return is_number(sample.current_A) && is_number(sample.position_m) && within(sample.time_step_s, T(longest_step_s));
}

/// The share by which a held answer's band opens in one more step of time [s], >= 0.
template <class T>
constexpr T held_opening(T time_step_s) {
  return smaller(time_step_s * T(1 / held_opening_s), T(1));
}

/// Why a sample cannot be estimated: current or position is missing, or time runs backwards. `none` where it can.
template <class T>
constexpr auto unusable(const Sample<T>& sample) {
  return when(!(is_number(sample.current_A) && is_number(sample.position_m)), Status::sample_missing) |
         when(!within(sample.time_step_s, T(endless_step_s)), Status::time_fault);
}

/// The flow rate with its band and what led to it. Signs: magnetic force opens (+), spring and flow force close (+),
/// friction has the sign of the velocity.
template <class T>
struct Estimate {
  T flow_m3_per_s{};
  T flow_lower_m3_per_s{};  ///< 95 % band
  T flow_upper_m3_per_s{};
  T pressure_difference_Pa{};
  T magnetic_force_N{};
  T spring_force_N{};
  T flow_force_N{};
  T friction_force_N{};
  typename ScalarTypes<T>::StatusWord status{};
};

}  // namespace spoolflow::sensor
