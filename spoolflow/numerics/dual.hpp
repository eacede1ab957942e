#pragma once
/// A number with its derivatives, so that the sensor's own templates compute how their answer depends on each input
/// (forward automatic differentiation).
#include <array>
#include <cmath>

namespace spoolflow::numerics {

/// Value and derivatives over `Inputs` inputs. Comparisons look at the value: where the sensor branches, the derivative
/// is that of the branch taken.
template <int Inputs>
struct Dual {
  double value = 0;
  std::array<double, Inputs> slope{};

  constexpr Dual() = default;
  constexpr explicit Dual(double number) : value(number) {}

  friend constexpr Dual chained(const Dual& a, double result, double per_a) {
    Dual out(result);
    for (std::size_t k = 0; k < Inputs; ++k) out.slope[k] = per_a * a.slope[k];
    return out;
  }
  friend constexpr Dual chained(const Dual& a, const Dual& b, double result, double per_a, double per_b) {
    Dual out(result);
    for (std::size_t k = 0; k < Inputs; ++k) out.slope[k] = per_a * a.slope[k] + per_b * b.slope[k];
    return out;
  }
  friend constexpr Dual operator-(const Dual& a) { return chained(a, -a.value, -1); }
  friend constexpr Dual operator+(const Dual& a, const Dual& b) { return chained(a, b, a.value + b.value, 1, 1); }
  friend constexpr Dual operator-(const Dual& a, const Dual& b) { return chained(a, b, a.value - b.value, 1, -1); }
  friend constexpr Dual operator*(const Dual& a, const Dual& b) {
    return chained(a, b, a.value * b.value, b.value, a.value);
  }
  friend constexpr Dual operator/(const Dual& a, const Dual& b) {
    return chained(a, b, a.value / b.value, 1 / b.value, -a.value / (b.value * b.value));
  }
  constexpr Dual& operator+=(const Dual& other) { return *this = *this + other; }
  constexpr Dual& operator-=(const Dual& other) { return *this = *this - other; }

  friend constexpr bool operator<(const Dual& a, const Dual& b) { return a.value < b.value; }
  friend constexpr bool operator>(const Dual& a, const Dual& b) { return a.value > b.value; }
  friend constexpr bool operator<=(const Dual& a, const Dual& b) { return a.value <= b.value; }
  friend constexpr bool operator>=(const Dual& a, const Dual& b) { return a.value >= b.value; }

  // What the sensor asks of every scalar (spoolflow/sensor/basis/scalar.hpp).
  friend constexpr int table_index(const Dual& a) { return static_cast<int>(a.value); }
  /// The slope at zero, infinite in truth, is taken as zero.
  friend Dual sqrt(const Dual& a) {
    const double root = std::sqrt(a.value);
    return chained(a, root, root > 0 ? 0.5 / root : 0);
  }
};

}  // namespace spoolflow::numerics
