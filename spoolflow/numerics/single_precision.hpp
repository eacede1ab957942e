#pragma once
/// Numbers and the sensor's parameters in single precision, as valves and batches have them.
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace spoolflow::numerics {

/// All numbers of `Parameters`, which are made of nothing else.
template <class Parameters>
std::vector<double> numbers_of(const Parameters& parameters) {
  static_assert(sizeof(Parameters) % sizeof(double) == 0);
  std::vector<double> numbers(sizeof(Parameters) / sizeof(double));
  std::memcpy(numbers.data(), &parameters, sizeof(Parameters));
  return numbers;
}

/// Below the smallest normal number zero. Throws std::invalid_argument where it is not finite in single precision.
[[nodiscard]] inline float single_precision(double number) {
  const auto single = static_cast<float>(number);
  if (!std::isfinite(single)) {
    std::array<char, 32> written{};
    const auto end = std::to_chars(written.data(), written.data() + written.size(), number).ptr;
    throw std::invalid_argument("the model's number " + std::string(written.data(), end) +
                                " does not fit into single precision (at most 3.4e+38); calibrate again and look at "
                                "the report for what went astray");
  }
  return std::abs(single) < std::numeric_limits<float>::min() ? 0.0F : single;
}

/// The sensor's parameters as the target has them.
template <template <class> class Parameters>
Parameters<float> single_precision(const Parameters<double>& parameters) {
  static_assert(2 * sizeof(Parameters<float>) == sizeof(Parameters<double>));
  const std::vector<double> numbers = numbers_of(parameters);
  std::array<float, sizeof(Parameters<float>) / sizeof(float)> single{};
  for (std::size_t k = 0; k < single.size(); ++k) single[k] = single_precision(numbers[k]);
  return std::bit_cast<Parameters<float>>(single);
}

}  // namespace spoolflow::numerics
