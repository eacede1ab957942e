#include "spoolflow/uncertainty/distribution.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace spoolflow::uncertainty {
namespace {

constexpr std::array<double, 6> middle_top{-3.969683028665376e+01, 2.209460984245205e+02,  -2.759285104469687e+02,
                                           1.383577518672690e+02,  -3.066479806614716e+01, 2.506628277459239e+00};
constexpr std::array<double, 6> middle_bottom{-5.447609879822406e+01, 1.615858368580409e+02,  -1.556989798598866e+02,
                                              6.680131188771972e+01,  -1.328068155288572e+01, 1.0};
constexpr std::array<double, 6> tail_top{-7.784894002430293e-03, -3.223964580411365e-01, -2.400758277161838e+00,
                                         -2.549732539343734e+00, 4.374664141464968e+00,  2.938163982698783e+00};
constexpr std::array<double, 5> tail_bottom{7.784695709041462e-03, 3.224671290700398e-01, 2.445134137142996e+00,
                                            3.754408661907416e+00, 1.0};

template <std::size_t Count>
double polynomial(const std::array<double, Count>& coefficients, double x) {
  double sum = 0;
  for (const double c : coefficients) sum = sum * x + c;
  return sum;
}

/// Share of Student's t beyond -t and t together, as the regularised incomplete beta function I_x(nu/2, 1/2) with
/// x = nu/(nu + t^2), by its continued fraction (Abramowitz and Stegun 26.5.8).
double share_beyond(double t, double nu) {
  const double a = 0.5 * nu;
  const double b = 0.5;
  const double x = nu / (nu + t * t);
  const bool mirrored = x > (a + 1) / (a + b + 2);  // where the fraction converges slowly
  const double p = mirrored ? b : a;
  const double q = mirrored ? a : b;
  const double y = mirrored ? 1 - x : x;
  const double front =
      std::exp(std::lgamma(p + q) - std::lgamma(p) - std::lgamma(q) + p * std::log(y) + q * std::log1p(-y)) / p;
  double fraction = 1;
  for (int m = 200; m > 0; --m) {
    const double odd = -(p + m - 1) * (p + q + m - 1) * y / ((p + 2 * m - 2) * (p + 2 * m - 1));
    const double even = m * (q - m) * y / ((p + 2 * m - 1) * (p + 2 * m));
    fraction = 1 + odd / (1 + even / fraction);
  }
  return mirrored ? 1 - front / fraction : front / fraction;
}

}  // namespace

std::string_view name(Distribution distribution) {
  switch (distribution) {
    case Distribution::rectangular:
      return "rectangular";
    case Distribution::two_point:
      return "two-point";
    case Distribution::normal:
      break;
  }
  return "normal";
}

double deviation_per_half_width(Distribution distribution) {
  switch (distribution) {
    case Distribution::rectangular:
      return 1 / std::numbers::sqrt3;
    case Distribution::two_point:
      return 1;
    case Distribution::normal:
      break;
  }
  return 1 / 1.959963984540054;
}

double quantile(Distribution distribution, double probability) {
  switch (distribution) {
    case Distribution::rectangular:
      return std::numbers::sqrt3 * (2 * probability - 1);
    case Distribution::two_point:
      return probability < 0.5 ? -1 : 1;
    case Distribution::normal:
      break;
  }
  return normal_quantile(probability);
}

double normal_quantile(double probability) {
  constexpr double tail = 0.02425;
  if (probability > 1 - tail) return -normal_quantile(1 - probability);
  if (probability < tail) {
    const double q = std::sqrt(-2 * std::log(probability));
    return polynomial(tail_top, q) / polynomial(tail_bottom, q);
  }
  const double q = probability - 0.5;
  return q * polynomial(middle_top, q * q) / polynomial(middle_bottom, q * q);
}

double normal_share_below(double value) {
  return 0.5 * std::erfc(-value / std::numbers::sqrt2);
}

double coverage_factor_95(double degrees_of_freedom) {
  constexpr double of_normal = 1.959963984540054;
  if (!(degrees_of_freedom < 1e6)) return of_normal;
  double low = of_normal;
  double high = 13;  // 12.7 at one degree of freedom
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = 0.5 * (low + high);
    (share_beyond(middle, degrees_of_freedom) > 0.05 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace spoolflow::uncertainty
