#pragma once
#include <cmath>
#include <cstdint>
#include <limits>

namespace spoolflow::numerics {

/// How a signal stands at its lowest and highest value, sample by sample: one that an amplifier or a recorder clips
/// stands there for some samples in a row, while its noise moves it everywhere else. NaN samples are passed over.
struct HeldExtremes {
  double lowest = std::numeric_limits<double>::infinity(), highest = -std::numeric_limits<double>::infinity();
  std::uint64_t samples = 0;
  std::uint64_t at_lowest = 0, at_highest = 0;  ///< samples of runs of at least three equal values at that extreme
  std::uint64_t repeated = 0;                   ///< samples like the one before
  std::uint64_t reversals = 0;                  ///< changes against the one before: noise, if many

  void take(double value) {
    if (std::isnan(value)) return;
    ++samples;
    if (value == last_) {
      ++repeated;
      ++run_;
      if (run_ < 3) return;
      const std::uint64_t counted = run_ == 3 ? 3 : 1;
      if (value == lowest) at_lowest += counted;
      if (value == highest) at_highest += counted;
      return;
    }
    run_ = 1;
    const double change = value - last_;
    reversals += static_cast<std::uint64_t>(change * last_change_ < 0);  // without a branch: noise goes as it likes
    if (!std::isnan(change)) last_change_ = change;
    last_ = value;
    if (value < lowest) lowest = value, at_lowest = 0;
    if (value > highest) highest = value, at_highest = 0;
  }

 private:
  double last_ = std::numeric_limits<double>::quiet_NaN(), last_change_ = 0;
  std::uint64_t run_ = 0;
};

}  // namespace spoolflow::numerics
