#pragma once
/// Numbers as people read them: a true minus sign, no negative zero, a dash for what is not known.
#include <string>

namespace spoolflow::report {

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
