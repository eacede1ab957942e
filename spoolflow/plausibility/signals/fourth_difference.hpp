#pragma once
/// White noise of samples that are equally far apart, by their differences of fourth order: what changes smoothly adds
/// nearly nothing to them.
#include <array>
#include <cmath>
#include <cstddef>

namespace spoolflow::plausibility {

inline constexpr std::array<double, 5> fourth_difference_weights{1, -4, 6, -4, 1};

/// Of five samples, in their unit.
[[nodiscard]] inline double fourth_difference(const double* samples) {
  double out = 0;
  for (std::size_t k = 0; k < fourth_difference_weights.size(); ++k) out += fourth_difference_weights[k] * samples[k];
  return out;
}

/// Standard deviation of white noise of which a quarter of all fourth differences are smaller than `quartile`, in size.
/// What shakes the samples for less than three quarters of the time does not count.
[[nodiscard]] inline double white_noise(double quartile) {
  double gain2 = 0;
  for (const double weight : fourth_difference_weights) gain2 += weight * weight;
  constexpr double deviations = 0.318639;  // a quarter of all lie so near to a normal distribution's mean
  return quartile / (deviations * std::sqrt(gain2));
}

}  // namespace spoolflow::plausibility
