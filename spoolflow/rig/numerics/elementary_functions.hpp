#pragma once
/// Elementary functions with the same last bit on every processor. The C library picks among variants that round
/// differently; after some stick and slip that last bit decides when a spool breaks away. Here are additions,
/// multiplications and divisions alone, which IEEE 754 rounds in one way only.
///
///     e^x    = 2^k e^r,  |r| <= ln 2/2, Taylor to r^13
///     ln x   = k ln 2 + 2 artanh((m - 1)/(m + 1)),  m in [sqrt 1/2, sqrt 2], series to the 23rd power
///     sin    of turns, folded to a quarter turn, Taylor to the 23rd power
///
/// Within 2 units in the last place (sine: of its amplitude).
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace spoolflow::rig {

namespace elementary {

inline constexpr double ln_2_high = 0x1.62e42feep-1;  ///< short enough that k ln_2_high is exact
inline constexpr double ln_2_low = 0x1.a39ef35793c76p-33;

/// 1/n!
inline constexpr std::array<double, 14> exponential_series = [] {
  std::array<double, 14> terms{1.0};
  double factorial = 1.0;
  for (std::size_t n = 1; n < terms.size(); ++n) terms[n] = 1.0 / (factorial *= static_cast<double>(n));
  return terms;
}();
/// (-1)^n/(2n+1)!
inline constexpr std::array<double, 12> sine_series = [] {
  std::array<double, 12> terms{1.0};
  double factorial = 1.0;
  for (std::size_t n = 1; n < terms.size(); ++n) {
    factorial *= -static_cast<double>(2 * n * (2 * n + 1));
    terms[n] = 1.0 / factorial;
  }
  return terms;
}();
/// 1/(2n+1)
inline constexpr std::array<double, 12> artanh_series = [] {
  std::array<double, 12> terms{};
  for (std::size_t n = 0; n < terms.size(); ++n) terms[n] = 1.0 / static_cast<double>(2 * n + 1);
  return terms;
}();

template <std::size_t count, class Scalar>
inline Scalar polynomial(const std::array<double, count>& terms, Scalar x) {
  Scalar sum = terms[count - 1];
  for (std::size_t n = count - 1; n-- > 0;) sum = terms[n] + x * sum;
  return sum;
}

}  // namespace elementary

/// e^x; 0 below -700, infinite above 700, NaN for NaN.
inline double exponential(double x) {
  if (!(std::abs(x) <= 700.0)) return x < 0.0 ? 0.0 : x + HUGE_VAL;
  constexpr double per_ln_2 = 1.4426950408889634;
  const double k = std::nearbyint(x * per_ln_2);
  const double r = (x - k * elementary::ln_2_high) - k * elementary::ln_2_low;
  const double power_of_two = std::bit_cast<double>((static_cast<std::int64_t>(k) + 1023) << 52);
  return elementary::polynomial(elementary::exponential_series, r) * power_of_two;
}

/// ln x for finite x > 0.
inline double natural_logarithm(double x) {
  int k = 0;
  double m = std::frexp(x, &k);  // 1/2 <= m < 1
  if (m < 0.70710678118654752) {
    m *= 2.0;
    --k;
  }
  const double s = (m - 1.0) / (m + 1.0);
  const double series = elementary::polynomial(elementary::artanh_series, s * s);
  const double whole = k;
  return whole * elementary::ln_2_high + (2.0 * s * series + whole * elementary::ln_2_low);
}

/// x^y for x > 0.
inline double power(double x, double y) {
  return exponential(y * natural_logarithm(x));
}

inline double decimal_logarithm(double x) {
  return natural_logarithm(x) * 0.43429448190325183;
}

/// Sine of an angle in turns: sin(2 pi t).
inline double sine_of_turns(double turns) {
  double t = turns - std::nearbyint(turns);
  if (t > 0.25) t = 0.5 - t;
  if (t < -0.25) t = -0.5 - t;
  const double x = 6.2831853071795865 * t;
  return x * elementary::polynomial(elementary::sine_series, x * x);
}

}  // namespace spoolflow::rig
