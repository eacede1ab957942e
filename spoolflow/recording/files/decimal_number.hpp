#pragma once
/// Numbers as recordings write them, such as -12.345: short ones eight bytes at once, the others by fast_float, all
/// with the result of std::from_chars.
#include <array>
#include <bit>
#include <cstdint>
#include <string_view>

#include "spoolflow/recording/files/eight_bytes.hpp"

namespace spoolflow::recording {

enum class Digits : std::uint8_t {
  number,
  empty,         ///< nothing but spaces, or NaN, NULL, -, n/a and the like
  not_finite,    ///< inf written out
  out_of_range,  ///< larger than a double can be
  not_a_number,
};

/// Reads `text`, spaces and quotes around it allowed, `point` as decimal sign; by fast_float, with a leading plus
/// allowed. Numbers too small for a double are zero.
[[nodiscard]] Digits read_number(std::string_view text, char point, double& value);

/// Whether it is one, by point or comma.
[[nodiscard]] bool is_number(std::string_view text);

/// 10^k, all of which a double holds exactly.
inline constexpr std::array<double, 23> exact_powers_of_ten{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                            1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                                            1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/// What read_decimal() leaves to others: more than seven characters, an exponent, or no number. `text` is behind the
/// sign.
[[nodiscard]] const char* read_long_decimal(const char* text, const char* end, char point, bool negative,
                                            double& value);

/// The number that begins a cell: perhaps a minus sign, digits, at most one decimal sign, perhaps an exponent. Returns
/// where it ends, or nullptr where read_number() has to look. Up to seven characters are read inline: digits and
/// decimals each as an integer, whose quotient is rounded once (Clinger 1990).
/// Before `end` stands a byte that ends the cell, and behind it there is scan_padding.
inline const char* read_decimal(const char* text, const char* end, char point, double& value) {
  const bool negative = *text == '-';
  if (negative) ++text;
  const std::uint64_t word = eight_bytes(text);
  std::uint64_t others = bytes_no_digits(word);
  if (others == 0) return read_long_decimal(text, end, point, negative, value);
  const auto whole = static_cast<unsigned>(std::countr_zero(others)) / 8;
  unsigned length = whole;
  unsigned decimals = 0;
  std::uint64_t digits = word;
  if (static_cast<char>(word >> 8 * whole) == point) {
    others &= others - 1;
    if (others == 0) return read_long_decimal(text, end, point, negative, value);
    length = static_cast<unsigned>(std::countr_zero(others)) / 8;
    decimals = length - whole - 1;
    const std::uint64_t before = (std::uint64_t{1} << 8 * whole) - 1;
    digits = (word & before) | (word >> 8 & ~before);
  }
  const unsigned count = whole + decimals;
  if (count == 0 || (static_cast<char>(word >> 8 * length) | 0x20) == 'e')
    return read_long_decimal(text, end, point, negative, value);
  const auto mantissa = static_cast<std::int64_t>(number_of_digits(digits << 8 * (8 - count)));
  const double magnitude = static_cast<double>(mantissa) / exact_powers_of_ten[decimals];
  value = negative ? -magnitude : magnitude;
  return text + length;
}

}  // namespace spoolflow::recording
