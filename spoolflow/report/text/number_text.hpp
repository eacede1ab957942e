#pragma once
/// Numbers as people read them: a true minus sign, no negative zero, a dash for what is not known.
#include <string>
#include <string_view>

#include "spoolflow/estimation/estimator.hpp"

namespace spoolflow::report {

/// As it stands in a sentence after "the": "condensed sensor", "observer".
[[nodiscard]] constexpr std::string_view sensor_name(estimation::Estimator estimator) {
  return estimator == estimation::Estimator::condensed ? "condensed sensor" : "observer";
}

[[nodiscard]] std::string fixed(double value, int decimals);
/// With its sign always.
[[nodiscard]] std::string signed_fixed(double value, int decimals);
/// About three digits, without an exponent where that reads better.
[[nodiscard]] std::string three_digits(double value);

/// Two significant digits, as an uncertainty is stated (JCGM 100, 7.2.6): "0.29", "3.4", "12". Above 99 whole numbers.
[[nodiscard]] std::string two_digits(double value);
/// With its sign always.
[[nodiscard]] std::string signed_two_digits(double value);

}  // namespace spoolflow::report
