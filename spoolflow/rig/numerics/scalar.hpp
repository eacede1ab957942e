#pragma once
/// The few operations that the plant's equations need of a number: `double` of one valve, or a pack of several valves'
/// numbers side by side (lanes.hpp), which blends where one valve branches. A pack's answers are those of its valves
/// alone to the last bit: additions, multiplications, divisions and roots, each rounded once, in the same order.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>

namespace spoolflow::rig {

/// What belongs to a number: the answer of a comparison.
template <class Scalar>
struct ScalarTypes {
  using Mask = bool;
};
template <class Scalar>
using Mask = typename ScalarTypes<Scalar>::Mask;

/// The type of an argument from which the number's type is not to be deduced.
template <class Type>
using Given = std::type_identity_t<Type>;

/// How many of something each valve has.
template <class Scalar>
using CountOf = std::conditional_t<std::is_same_v<Mask<Scalar>, bool>, std::size_t, Scalar>;

inline bool any(bool condition) {
  return condition;
}
inline bool all(bool condition) {
  return condition;
}

/// `condition ? yes : no`.
inline double select(bool condition, double yes, double no) {
  return condition ? yes : no;
}
template <class Aggregate>
Aggregate blended(bool condition, const Aggregate& yes, const Aggregate& no) {
  return condition ? yes : no;
}
/// Puts `value` in the place of `to` for those valves that take it; one valve is asked only where it does.
template <class Aggregate>
void take(bool /*taken*/, Aggregate& to, const Given<Aggregate>& value) {
  to = value;
}
inline double magnitude(double x) {
  return std::abs(x);
}
inline double square_root(double x) {
  return std::sqrt(x);
}
/// Ties to even.
inline double nearest_whole(double x) {
  return std::nearbyint(x);
}

/// As std::max, std::min and std::clamp choose among equal numbers and NaN.
inline double larger(double a, double b) {
  return std::max(a, b);
}
inline double smaller(double a, double b) {
  return std::min(a, b);
}
inline double clamped(double x, double least, double most) {
  return std::clamp(x, least, most);
}

}  // namespace spoolflow::rig
