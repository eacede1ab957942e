#pragma once
/// Numbers as recordings write them, such as -12.345: short ones eight bytes at once, the others by fast_float, all
/// with the result of std::from_chars.
#include <array>
#include <bit>
#include <cstdint>
#include <string>
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

/// The beginning of a cell's text, for a message.
[[nodiscard]] std::string shortened(std::string_view text);

/// 10^k, all of which a double holds exactly.
inline constexpr std::array<double, 23> exact_powers_of_ten{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                            1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                                            1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/// Without a branch: signs of noise come as they like, and a wrong guess costs more than the number.
inline double signed_number(double magnitude, bool negative) {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(magnitude) | std::uint64_t{negative} << 63);
}

/// Digits, perhaps with one decimal sign among them, without the sign; and how many stand behind it.
struct EightDigits {
  std::uint64_t digits;
  unsigned decimals;
  bool has_point;
};

/// Of eight characters, taking in `before`, the one before them, where a point goes out.
inline EightDigits without_point(std::uint64_t word, char point, std::uint64_t before) {
  const std::uint64_t difference = word ^ eight_times(static_cast<unsigned char>(point));
  // The lowest mark is right; where there are more, no digit stands there.
  const std::uint64_t mark = (difference - eight_times(1)) & ~difference & eight_times(0x80);
  if (mark == 0) return {word, 0, false};
  const std::uint64_t left = word & ((mark >> 7) - 1);
  const std::uint64_t right = word & ~(mark | (mark - 1));
  return {right | left << 8 | before, 7 - static_cast<unsigned>(std::countr_zero(mark)) / 8, true};
}

/// So many '0' before the digits of a word that has `length` of them, 1 to 8.
constexpr std::uint64_t zeros_before(std::size_t length) {
  return eight_times('0') >> 8 * (length - 1) >> 8;
}

/// What read_decimal() leaves to others: more than eight characters, an exponent, or no number. `text` is behind the
/// sign.
[[nodiscard]] bool read_long_decimal(const char* text, const char* end, char point, bool negative, double& value);

/// The number that a cell is: perhaps a minus sign, digits, at most one decimal sign, perhaps an exponent. False where
/// read_number() has to look. Up to eight characters are read inline, as one integer that a power of ten divides, which
/// rounds once (Clinger 1990). Behind `end` there are eight bytes that may be looked at.
inline bool read_decimal(const char* text, const char* end, char point, double& value) {
  const bool negative = *text == '-';
  text += static_cast<int>(negative);
  const auto length = static_cast<std::size_t>(end - text);
  if (length - 1 >= 8) return read_long_decimal(text, end, point, negative, value);
  const std::uint64_t word = eight_bytes(text) << 8 * (8 - length) | zeros_before(length);
  const auto [digits, decimals, has_point] = without_point(word, point, '0');
  if (bytes_no_digits(digits) != 0 || length == static_cast<std::size_t>(has_point))
    return read_long_decimal(text, end, point, negative, value);
  const auto mantissa = static_cast<std::int64_t>(number_of_digits(digits));
  value = signed_number(static_cast<double>(mantissa) / exact_powers_of_ten[decimals], negative);
  return true;
}

}  // namespace spoolflow::recording
