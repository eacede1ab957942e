#pragma once
/// Long columns of numbers as a page carries them: 16-bit codes in base64, little-endian.
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace spoolflow::report {

/// value = offset + scale * code. The range of the column is divided into 65000 steps; code -32768 is a value that is
/// not known.
struct PackedNumbers {
  double offset = 0;
  double scale = 1;
  std::string base64;
};

/// `factor` takes the values into the page's unit.
[[nodiscard]] PackedNumbers packed(std::span<const float> values, double factor);

/// Times in s: even steps where they are even to a hundredth of a step, else 32-bit counts of a tick in base64.
struct PackedTimes {
  double start_s = 0;
  double step_s = 1;
  std::size_t count = 0;
  std::string base64;  ///< empty: even steps; else counts of `step_s`
};
[[nodiscard]] PackedTimes packed_times(std::span<const double> time_s);

[[nodiscard]] std::string base64_of(std::span<const std::uint16_t> numbers);
[[nodiscard]] std::string base64_of(std::span<const std::uint32_t> numbers);

}  // namespace spoolflow::report
