#pragma once
/// Reads what a page carries, as its script does.
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "spoolflow/report/figures/packed_numbers.hpp"

namespace spoolflow::report {

/// Little-endian numbers of a base64 text.
template <class Number>
std::vector<Number> numbers_of(const std::string& base64) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::uint8_t> bytes;
  std::uint32_t word = 0;
  int bits = 0;
  for (const char c : base64) {
    const std::size_t digit = digits.find(c);
    if (digit == std::string_view::npos) break;
    word = word << 6U | static_cast<std::uint32_t>(digit);
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes.push_back(static_cast<std::uint8_t>(word >> bits));
  }
  std::vector<Number> out;
  for (std::size_t k = 0; k + sizeof(Number) <= bytes.size(); k += sizeof(Number)) {
    std::uint64_t number = 0;
    for (std::size_t b = 0; b < sizeof(Number); ++b) number |= static_cast<std::uint64_t>(bytes[k + b]) << (8 * b);
    out.push_back(static_cast<Number>(number));
  }
  return out;
}

inline std::vector<double> unpacked(const PackedNumbers& column) {
  std::vector<double> out;
  for (const std::uint16_t code : numbers_of<std::uint16_t>(column.base64)) {
    const auto signed_code = static_cast<std::int16_t>(code);
    out.push_back(signed_code == -32768 ? std::numeric_limits<double>::quiet_NaN()
                                        : column.offset + column.scale * signed_code);
  }
  return out;
}

}  // namespace spoolflow::report
