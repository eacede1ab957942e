#pragma once
/// The oil temperature, from a signal that is noisy, may be missing and may break.
#include <type_traits>

#include "spoolflow/sensor/basis/compiler.hpp"
#include "spoolflow/sensor/basis/due.hpp"
#include "spoolflow/sensor/basis/scalar.hpp"

namespace spoolflow::sensor {

/// The oil warms slowly and its sensor is noisy [s].
inline constexpr double temperature_smoothing_s = 2;
/// No oil that a valve has is colder or warmer [K]: the sensor or its line is broken.
inline constexpr double coldest_oil_K = 233.15;
inline constexpr double warmest_oil_K = 423.15;
/// A reading that differs by more than this [K] from the smoothed one is a fault, ...
inline constexpr double oil_leap_K = 15;
/// ... unless it lasts for longer than this [s].
inline constexpr double longest_oil_fault_s = 20;
/// Before a plausible reading has come an implausible one has been so for as long [s].
inline constexpr double first_oil_fault_s = 1e-3;

template <class T>
struct OilState {
  T temperature_K{};  ///< smoothed
  T fault_s{};        ///< for how long the signal has been implausible; 0: it is not
  bool measured{};    ///< a plausible temperature has come; until then the usual one stands in
};

static_assert(std::is_trivially_copyable_v<OilState<float>>);

template <class T>
constexpr bool is_oil_temperature(T temperature_K) {
  return lies_below(T(coldest_oil_K), temperature_K) && lies_below(temperature_K, T(warmest_oil_K));
}

/// To be called before the first sample, and until a plausible temperature has come. `usual_K` stands in for it.
template <class T>
constexpr void begin(OilState<T>& oil, T measured_K, T usual_K) {
  oil.measured = is_oil_temperature(measured_K);
  oil.temperature_K = oil.measured ? measured_K : usual_K;
  oil.fault_s = !oil.measured && is_number(measured_K) ? T(first_oil_fault_s) : T(0);
}

namespace detail {

/// Counts how long the signal has been implausible. A leap to what oil may have is accepted once it has lasted.
template <class T>
constexpr void count_fault(OilState<T>& oil, T measured_K, bool implausible, T since_s) {
  oil.fault_s = implausible ? oil.fault_s + since_s : T(0);
  if (is_oil_temperature(measured_K) && oil.fault_s > T(longest_oil_fault_s)) oil.temperature_K = measured_K;
}

}  // namespace detail

/// One sample [K]. The last temperature is held where it is missing, no oil has it, or it leaps from those measured.
template <class T>
constexpr void follow_temperature(OilState<T>& oil, T measured_K, const Due<T>& due) {
  if (!due.now || !is_number(measured_K)) return;
  if (unlikely(!oil.measured)) {
    begin(oil, measured_K, oil.temperature_K);
    return;
  }
  const T change_K = measured_K - oil.temperature_K;
  const bool implausible = magnitude(change_K) > T(oil_leap_K) || !is_oil_temperature(measured_K);
  const T pace = smaller(due.since_s() * T(1 / temperature_smoothing_s), T(1));
  oil.temperature_K += (implausible ? T(0) : pace) * change_K;
  if (implausible || oil.fault_s > T(0)) detail::count_fault(oil, measured_K, implausible, due.since_s());
}

}  // namespace spoolflow::sensor
