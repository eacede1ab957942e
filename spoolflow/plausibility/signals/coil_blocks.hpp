#pragma once
/// A coil and what it moves in means over short blocks of equal length, which hold one value after the other.
#include <cmath>
#include <cstddef>
#include <vector>

namespace spoolflow::plausibility {

/// v = R i by least squares over all means; pairs without two numbers are left out.
class CoilResistance {
 public:
  void take(double current_A, double voltage_V) {
    if (!std::isfinite(current_A + voltage_V)) return;
    both_ += voltage_V * current_A;
    squares_ += current_A * current_A;
  }
  /// NaN where no current was seen.
  [[nodiscard]] double Ohm() const { return both_ / squares_; }

 private:
  double both_ = 0, squares_ = 0;
};

inline double resistance_Ohm_of(const std::vector<double>& current_A, const std::vector<double>& voltage_V) {
  CoilResistance resistance;
  for (std::size_t k = 0; k < current_A.size(); ++k) resistance.take(current_A[k], voltage_V[k]);
  return resistance.Ohm();
}

/// What the coil has beside its resistance, over three blocks [V]: what a changing flux linkage induces over the
/// changes that rate() sees. `k` from 1 to the last but one.
inline double induced_V(const std::vector<double>& current_A, const std::vector<double>& voltage_V,
                        double resistance_Ohm, std::size_t k) {
  double sum = 0;
  for (std::size_t j = k - 1; j <= k + 1; ++j) sum += voltage_V[j] - resistance_Ohm * current_A[j];
  return sum / 3;
}

/// Per second, by two blocks on either side of `k`, which is from 2 to the last but two.
inline double rate(const std::vector<double>& means, std::size_t k, double block_s) {
  return (means[k + 1] + means[k + 2] - means[k - 1] - means[k - 2]) / (6 * block_s);
}

}  // namespace spoolflow::plausibility
