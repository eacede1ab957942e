#pragma once
/// Reads decimal numbers as fast as a recording needs it, bit for bit as std::from_chars does.
#include <array>
#include <charconv>
#include <cstdint>
#include <system_error>

namespace spoolflow::recording {

/// What was read and where it ended; `end` is null where there was no number.
struct Decimal {
  double value;
  const char* end;
};

/// [+-]digits[.digits][e[+-]digits] in [begin, end); `point` is '.' or ','. A mantissa below 2^53 with a power of ten
/// up to 22 is exact in one multiplication or division (Clinger 1990); everything else goes to std::from_chars, but for
/// a decimal comma, which is then rewritten. "nan" and "inf" are no numbers here.
[[nodiscard]] inline Decimal read_decimal(const char* begin, const char* end, char point) {
  constexpr std::array<double, 23> power{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                         1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
  const char* at = begin;
  bool negative = false;
  if (at != end && (*at == '-' || *at == '+')) {
    negative = *at == '-';
    ++at;
  }
  const char* const number = at;
  std::uint64_t mantissa = 0;
  const char* const whole = at;
  while (at != end && static_cast<unsigned char>(*at - '0') < 10)
    mantissa = mantissa * 10 + static_cast<std::uint64_t>(*at++ - '0');
  std::int64_t digits = at - whole;
  std::int64_t exponent = 0;
  if (at != end && *at == point) {
    const char* const fraction = ++at;
    while (at != end && static_cast<unsigned char>(*at - '0') < 10)
      mantissa = mantissa * 10 + static_cast<std::uint64_t>(*at++ - '0');
    exponent = fraction - at;
    digits -= exponent;
  }
  if (digits == 0) return {0, nullptr};
  const bool scientific = at != end && (*at == 'e' || *at == 'E');
  if (!scientific && digits <= 18 && mantissa <= (std::uint64_t{1} << 53) && exponent >= -22) {
    const double value = static_cast<double>(mantissa) / power[static_cast<std::size_t>(-exponent)];
    return {negative ? -value : value, at};
  }
  std::array<char, 512> text;
  std::size_t length = 0;
  for (const char* c = number; c != end && length < text.size() && *c != '\r' && *c != '\n'; ++c) {
    text[length++] = *c == point ? '.' : *c;
    if (*c == ' ' || *c == ';' || *c == '\t' || *c == '"') break;
  }
  double value = 0;
  const auto read = std::from_chars(text.data(), text.data() + length, value);
  if (read.ec == std::errc::invalid_argument) return {0, nullptr};
  if (read.ec == std::errc::result_out_of_range) return {0, nullptr};
  return {negative ? -value : value, number + (read.ptr - text.data())};
}

}  // namespace spoolflow::recording
