#pragma once
#include <cmath>
#include <cstddef>

namespace spoolflow::calibration {

/// Gathers the deviations of samples from a fit; NaN deviations (missing samples) are passed over.
struct FitResidual {
  double sum_of_squares = 0;
  double largest = 0;
  std::size_t samples = 0;

  void add(double deviation) {
    if (std::isnan(deviation)) return;
    sum_of_squares += deviation * deviation;
    largest = std::fmax(largest, std::abs(deviation));
    ++samples;
  }
  [[nodiscard]] double rms() const {
    return samples == 0 ? 0 : std::sqrt(sum_of_squares / static_cast<double>(samples));
  }
};

}  // namespace spoolflow::calibration
