#pragma once
#include <cmath>
#include <cstddef>
#include <span>

namespace spoolflow::validation {

/// What a meter with the time constant `lag_s` shows of `values`, in place: exactly, for values that hold between
/// samples. Without a lag it shows the values.
template <class Number>
void apply_lag(std::span<const double> time_s, std::span<Number> values, double lag_s) {
  if (!(lag_s > 0)) return;
  for (std::size_t k = 1; k < values.size(); ++k) {
    const double share = -std::expm1(-(time_s[k] - time_s[k - 1]) / lag_s);
    values[k] = static_cast<Number>(values[k - 1] + share * (values[k] - values[k - 1]));
  }
}

}  // namespace spoolflow::validation
