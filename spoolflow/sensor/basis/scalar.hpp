#pragma once
/// The few operations that every scalar of the sensor supports: float in the valve, double on a host, an
/// automatic-differentiation number in calibration, which overloads these for itself, found by argument-dependent
/// lookup.
#include <array>
#include <cstdint>
#include <type_traits>

#include "spoolflow/sensor/basis/compiler.hpp"

#if defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__
#error "a missing input is a NaN: compile without -ffast-math and -ffinite-math-only"
#endif

namespace spoolflow::sensor {

enum class Status : std::uint32_t;

/// The type parameter of what is there for float and double alone.
template <class T>
using IfNumber = std::enable_if_t<std::is_floating_point_v<T>, int>;

/// So many numbers of a table; counts are signed, as places are.
template <class T, int Count>
using Numbers = std::array<T, static_cast<unsigned>(Count)>;

/// The integer part of a number >= 0, as a table index.
template <class T, IfNumber<T> = 0>
constexpr int table_index(T value) {
  return static_cast<int>(value);
}

/// The bits of a float or a double, which order positive numbers as they are; the sign bit and NaN lie beyond.
template <class T>
constexpr auto bits_of(T value) {
  return bits_as<std::conditional_t<sizeof(T) == sizeof(std::uint32_t), std::uint32_t, std::uint64_t>>(value);
}
/// Whether numbers are compared by their bits: one comparison of integers, no detour over the floating-point unit's
/// flags.
template <class T>
inline constexpr bool by_bits = SPOOLFLOW_CONSTANT_BITS != 0 && (std::is_same_v<T, float> || std::is_same_v<T, double>);

/// Whether 0 <= value < highest, where highest > 0.
template <class T>
constexpr bool within(T value, T highest) {
  if constexpr (by_bits<T>) return bits_of(value) < bits_of(highest);
  return value >= T(0) && value < highest;
}

/// Whether 0 < value < highest, where highest > 0.
template <class T>
constexpr bool strictly_within(T value, T highest) {
  if constexpr (by_bits<T>) return bits_of(value) - 1U < bits_of(highest) - 1U;
  return value > T(0) && value < highest;
}

/// Whether value < limit, where neither is below zero; NaN lies below nothing.
template <class T>
constexpr bool lies_below(T value, T limit) {
  return value < limit;
}

/// Whether value > limit, where neither is above zero; NaN lies above nothing.
template <class T>
constexpr bool lies_above(T value, T limit) {
  return value > limit;
}

template <class T>
constexpr T smaller(T a, T b) {
  return b < a ? b : a;
}

template <class T>
constexpr T larger(T a, T b) {
  return a < b ? b : a;
}

/// The larger of a number and zero.
template <class T>
constexpr T at_least_zero(T value) {
  return larger(value, T(0));
}

template <class T>
constexpr T limited(T value, T lowest, T highest) {
  if (likely(!(value < lowest) && !(highest < value))) return value;
  return smaller(larger(value, lowest), highest);
}

template <class T>
constexpr T magnitude(T value) {
  return value < T(0) ? -value : value;
}

/// The number, no further from zero than `most`, >= 0.
template <class T>
constexpr T limited_size(T value, T most) {
  if (likely(!(magnitude(value) > most))) return value;
  return value < T(0) ? -most : most;
}

/// The number, no less than zero and no more than `most`, > 0.
template <class T>
constexpr T from_zero_to(T most, T value) {
  if (likely(within(value, most))) return value;
  return smaller(at_least_zero(value), most);
}

template <class T>
constexpr T squared(T value) {
  return value * value;
}

/// Whether a number is nothing, as what was never set; not whether arithmetic has come to nothing.
template <class T>
constexpr bool is_zero(T value) {
  if constexpr (by_bits<T>) return bits_of(value) << 1U == 0U;
  return same(value, T(0));
}

/// Whether an input, in SI units, was measured at all: not NaN, not infinite, not beyond what any valve has.
template <class T>
constexpr bool is_number(T value) {
  if constexpr (by_bits<T>) return bits_of(value) << 1U < bits_of(T(1 << 30)) << 1U;
  return value > T(-(1 << 30)) && value < T(1 << 30);
}

#if SPOOLFLOW_CONSTANT_BITS
/// A float's bits as a number with a sign. By way of the number without one that `within` compares: compilers then see
/// that it is the same word, and fetch it once.
constexpr std::int32_t signed_bits(float value) {
  return static_cast<std::int32_t>(bits_of(value));
}
/// A limit may also be below zero, or NaN a value.
constexpr bool lies_below(float value, float limit) {
  return signed_bits(value) < signed_bits(limit);
}
constexpr bool lies_above(float value, float limit) {
  return signed_bits(value) < signed_bits(limit);
}
/// The sign bit, spread over the word, takes all bits away: no comparison, no branch.
constexpr float at_least_zero(float value) {
  const auto bits = signed_bits(value);
  return bits_as<float>(bits & ~(bits >> 31));
}
#endif

}  // namespace spoolflow::sensor
