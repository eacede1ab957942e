#pragma once
/// What goes into the sensor and what comes out, each sample.
#include <limits>

#include "spoolflow/sensor/basis/compiler.hpp"
#include "spoolflow/sensor/basis/scalar.hpp"
#include "spoolflow/sensor/basis/status.hpp"

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

/// The sample with another coil current, which no voltage goes with.
template <class T>
constexpr Sample<T> with_current(const Sample<T>& sample, T current_A) {
  return {sample.time_step_s, current_A, std::numeric_limits<T>::quiet_NaN(), sample.position_m,
          sample.oil_temperature_K};
}

/// A spool that reads so far beyond half the overlap on the closed side [m] opens the other direction of flow: no zero
/// drifts as far.
inline constexpr double other_direction_m = 50e-6;

/// The sensor is made for time steps up to 5 ms, and one that a lost sample doubles passes. One of this length [s] or
/// more is estimated with time_fault: the source stalls, or gives milliseconds as seconds.
inline constexpr double longest_regular_step_s = 9e-3;
/// After a longer time step [s] nothing that was estimated before counts: the sensor starts again.
inline constexpr int longest_step_s = 1;
/// A time step of this length [s] or more is invalid.
inline constexpr int endless_step_s = 1 << 30;

/// A spool without a measured position is taken to go from end to end in so long [s].
inline constexpr double unobserved_stroke_s = 0.4;

/// Whether time leapt between the last sample and this one.
template <class T>
constexpr bool time_leapt(T time_step_s) {
  return lies_below(T(longest_step_s), time_step_s);
}

/// What nearly always holds: nothing is missing, and time has advanced by an ordinary step.
template <class T>
constexpr bool ordinary(const Sample<T>& sample) {
  return is_number(magnitude(sample.current_A) + magnitude(sample.position_m)) &&
         strictly_within(sample.time_step_s, T(longest_regular_step_s));
}

/// Whether the time step is longer than the sensor is made for, or none.
template <class T>
constexpr bool is_irregular(T time_step_s) {
  return !strictly_within(time_step_s, T(longest_regular_step_s));
}

/// Why a sample cannot be estimated: current or position is missing, or time runs backwards. `none` where it can.
template <class T>
constexpr auto unusable(const Sample<T>& sample) {
  return when(!(is_number(sample.current_A) && is_number(sample.position_m)), Status::sample_missing) |
         when(!within(sample.time_step_s, T(endless_step_s)), Status::time_fault);
}

/// The valve's position sensor.
template <class T>
struct PositionSensor {
  T noise_m{};                        ///< standard deviation of one sample
  T backlash_m{};                     ///< half-width: how far the spool may creep unobserved
  T drift_m_per_K{};                  ///< of the zero point over the oil temperature
  T drift_free_K{};                   ///< oil temperature at which the zero point is right
  T hardest_acceleration_m_per_s2{};  ///< no spool moves harder: a jump beyond it is a fault of the signal
};

/// What the oil temperature [K] does to the signal's zero [m].
template <class T>
constexpr T drift_m(const PositionSensor<T>& sensor, T oil_temperature_K) {
  return sensor.drift_m_per_K * (oil_temperature_K - sensor.drift_free_K);
}

/// The signal [m] without what the oil temperature [K] does to its zero.
template <class T>
constexpr T drift_free_m(const PositionSensor<T>& sensor, T position_m, T oil_temperature_K) {
  return position_m - drift_m(sensor, oil_temperature_K);
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
  Status status{};
};

/// What may flow [m3/s].
template <class T>
struct FlowRange {
  T least;
  T most;
};

/// Opens the band to both sides by an error that is independent of what made it; `half2` is the square of half its
/// width [m6/s2].
template <class T>
SPOOLFLOW_INLINE constexpr void widen_band(Estimate<T>& out, T half2) {
  const T flow = out.flow_m3_per_s;
  out.flow_lower_m3_per_s = flow - sqrt(squared(flow - out.flow_lower_m3_per_s) + half2);
  out.flow_upper_m3_per_s = flow + sqrt(squared(out.flow_upper_m3_per_s - flow) + half2);
}

/// Opens the band of a held answer to what may flow: at once, or as an unobserved spool goes to its ends in one
/// more step of time [s], >= 0. The flow stays. What a broken state makes no number of opens nothing.
template <class T>
constexpr void open_band(Estimate<T>& held, const FlowRange<T>& range, bool at_once, T time_step_s) {
  const T reach = smaller(time_step_s * T(1 / unobserved_stroke_s), T(1)) * (range.most - range.least);
  const T lower = held.flow_lower_m3_per_s, upper = held.flow_upper_m3_per_s;
  held.flow_lower_m3_per_s = smaller(lower, at_once ? range.least : larger(lower - reach, range.least));
  held.flow_upper_m3_per_s = larger(upper, at_once ? range.most : smaller(upper + reach, range.most));
}

}  // namespace spoolflow::sensor
