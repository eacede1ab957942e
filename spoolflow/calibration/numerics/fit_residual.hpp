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
  /// Those of another as if they had been added here.
  FitResidual& operator+=(const FitResidual& other) {
    sum_of_squares += other.sum_of_squares;
    largest = std::fmax(largest, other.largest);
    samples += other.samples;
    return *this;
  }
  [[nodiscard]] double rms() const {
    return samples == 0 ? 0 : std::sqrt(sum_of_squares / static_cast<double>(samples));
  }
};

}  // namespace spoolflow::calibration
