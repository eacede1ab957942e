#include "spoolflow/report/figures/packed_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spoolflow::report {
namespace {

constexpr std::int16_t missing = -32768;
constexpr double largest_code = 32500;

std::string base64(const std::vector<std::uint8_t>& bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    const std::size_t there = std::min<std::size_t>(3, bytes.size() - k);
    std::uint32_t word = 0;
    for (std::size_t b = 0; b < 3; ++b) word = word << 8U | (b < there ? bytes[k + b] : 0U);
    for (std::size_t d = 0; d < 4; ++d) out += d <= there ? digits[word >> (18 - 6 * d) & 63U] : '=';
  }
  return out;
}

template <class Number>
std::string base64_of_numbers(std::span<const Number> numbers) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(numbers.size() * sizeof(Number));
  for (const Number number : numbers) {
    for (std::size_t b = 0; b < sizeof(Number); ++b) bytes.push_back(static_cast<std::uint8_t>(number >> (8 * b)));
  }
  return base64(bytes);
}

}  // namespace

std::string base64_of(std::span<const std::uint16_t> numbers) {
  return base64_of_numbers(numbers);
}
std::string base64_of(std::span<const std::uint32_t> numbers) {
  return base64_of_numbers(numbers);
}

PackedNumbers packed(std::span<const float> values, double factor) {
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -lowest;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    lowest = std::min(lowest, value * factor);
    highest = std::max(highest, value * factor);
  }
  PackedNumbers out;
  if (lowest <= highest) out.offset = 0.5 * (lowest + highest);
  if (lowest < highest) out.scale = (highest - lowest) / (2 * largest_code);
  std::vector<std::uint16_t> codes;
  codes.reserve(values.size());
  for (const double value : values) {
    const std::int16_t code = std::isfinite(value)
                                  ? static_cast<std::int16_t>(std::lround((value * factor - out.offset) / out.scale))
                                  : missing;
    codes.push_back(static_cast<std::uint16_t>(code));
  }
  out.base64 = base64_of(codes);
  return out;
}

PackedTimes packed_times(std::span<const double> time_s) {
  PackedTimes out;
  out.count = time_s.size();
  if (time_s.empty()) return out;
  out.start_s = time_s.front();
  if (time_s.size() == 1) return out;
  const double duration_s = time_s.back() - time_s.front();
  const double step_s = duration_s / static_cast<double>(time_s.size() - 1);
  bool even = step_s > 0;
  for (std::size_t k = 0; even && k < time_s.size(); ++k) {
    even = std::abs(time_s[k] - out.start_s - static_cast<double>(k) * step_s) < 0.01 * step_s;
  }
  if (step_s > 0) out.step_s = step_s;
  if (even) return out;
  out.step_s = duration_s > 0 ? duration_s / std::numeric_limits<std::uint32_t>::max() : 1;
  std::vector<std::uint32_t> counts;
  counts.reserve(time_s.size());
  std::uint32_t latest = 0;
  for (const double time : time_s) {
    const double count = std::clamp((time - out.start_s) / out.step_s, 0.0,
                                    static_cast<double>(std::numeric_limits<std::uint32_t>::max()));
    latest = std::max(latest, static_cast<std::uint32_t>(count));  // a clock that ran backwards stands still here
    counts.push_back(latest);
  }
  out.base64 = base64_of_numbers(std::span<const std::uint32_t>(counts));
  return out;
}

}  // namespace spoolflow::report
