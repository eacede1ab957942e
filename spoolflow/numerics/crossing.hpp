#pragma once

namespace spoolflow::numerics {

struct Between {
  double low, high;
};

constexpr int halvings_to_rounding = 60;  // of a double's 53 binary digits, and some that an end near zero has more

/// The argument at which a rising function reaches `wanted`, by bisection: the low end where it lies above already, the
/// high end where it never does. Where a measured function falls in between, one of the arguments at which it passes
/// the value upwards.
template <class Function>
[[nodiscard]] double crossing(Between ends, double wanted, const Function& rising,
                              int halvings = halvings_to_rounding) {
  for (int halving = 0; halving < halvings; ++halving) {
    const double middle = 0.5 * (ends.low + ends.high);
    if (middle == ends.low || middle == ends.high) break;
    (rising(middle) < wanted ? ends.low : ends.high) = middle;
  }
  return 0.5 * (ends.low + ends.high);
}

}  // namespace spoolflow::numerics
