#pragma once
/// Numbers as people read them: a true minus sign, no negative zero, a dash for what is not known.
#include <string>

namespace spoolflow::report {

[[nodiscard]] std::string fixed(double value, int decimals);
/// With its sign always.
[[nodiscard]] std::string signed_fixed(double value, int decimals);
/// About three digits, without an exponent where that reads better.
[[nodiscard]] std::string three_digits(double value);

}  // namespace spoolflow::report
