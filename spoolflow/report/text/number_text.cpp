#include "spoolflow/report/text/number_text.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace spoolflow::report {

namespace {

constexpr const char* minus = "\u2212";
constexpr const char* unknown = "\u2013";

/// Decimals that leave two significant digits of the value as it is rounded: 0.996 is 1.0. Below a thousandth three.
int decimals_of_two_digits(double value) {
  constexpr int most = 3;
  for (int decimals = 0; decimals < most; ++decimals) {
    const double shown = std::round(std::abs(value) * std::pow(10.0, decimals)) / std::pow(10.0, decimals);
    if (shown >= 10.0 * std::pow(10.0, -decimals)) return decimals;
  }
  return most;
}

}  // namespace

std::string fixed(double value, int decimals) {
  if (!std::isfinite(value)) return unknown;
  const std::string magnitude = fmt::format("{:.{}f}", std::abs(value), decimals);
  const bool zero = magnitude.find_first_not_of("0.") == std::string::npos;
  return value < 0 && !zero ? minus + magnitude : magnitude;
}

std::string signed_fixed(double value, int decimals) {
  const std::string text = fixed(value, decimals);
  const bool zero = text.find_first_not_of("0.") == std::string::npos;
  return std::isfinite(value) && value > 0 && !zero ? "+" + text : text;
}

std::string two_digits(double value) {
  return value == 0 ? "0.0" : fixed(value, decimals_of_two_digits(value));
}

std::string signed_two_digits(double value) {
  return value == 0 ? "0.0" : signed_fixed(value, decimals_of_two_digits(value));
}

std::string three_digits(double value) {
  if (!std::isfinite(value)) return unknown;
  if (value == 0) return "0";
  const int leading = static_cast<int>(std::floor(std::log10(std::abs(value))));
  if (leading < -4 || leading > 6) return fmt::format("{:.2e}", value);
  return fixed(value, std::clamp(2 - leading, 0, 6));
}

}  // namespace spoolflow::report
