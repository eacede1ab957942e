#include "spoolflow/recording/files/decimal_number.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fast_float/fast_float.h>
#include <system_error>

namespace spoolflow::recording {
namespace {

constexpr std::size_t longest = 400;  // no number of a recording is longer

std::string_view bare(std::string_view text) {
  const auto is_space = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  const auto trim = [&](std::string_view inner) {
    while (!inner.empty() && is_space(inner.front())) inner.remove_prefix(1);
    while (!inner.empty() && is_space(inner.back())) inner.remove_suffix(1);
    return inner;
  };
  text = trim(text);
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') text = trim(text.substr(1, text.size() - 2));
  return text;
}

/// How programs write that there is no number.
bool says_missing(std::string_view text) {
  constexpr std::array<std::string_view, 19> words{
      "nan", "null", "-", "na", "n/a", "#n/a", "--", "---", "none", "-nan",
      // Of C libraries: glibc and Microsoft's, which writes the kind of NaN.
      "+nan", "nan(ind)", "-nan(ind)", "1.#qnan", "-1.#qnan", "1.#ind", "-1.#ind", "nan(snan)", "1.#snan"};
  constexpr std::size_t longest_word = 9;
  if (text.size() > longest_word) return false;
  std::array<char, longest_word> small{};
  std::ranges::transform(text, small.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return std::ranges::count(words, std::string_view(small.data(), text.size())) > 0;
}

/// Nine to sixteen characters, with up to seven decimals, as times have them. False where it is other.
bool read_sixteen(const char* text, const char* end, char point, double& magnitude) {
  const auto length = static_cast<std::size_t>(end - text);
  if (length < 9 || length > 16) return false;
  const std::uint64_t first = eight_bytes(text) << 8 * (16 - length) | zeros_before(length - 8);
  const auto [digits, decimals, has_point] = without_point(eight_bytes(end - 8), point, first >> 56);
  const std::uint64_t before = first << 8 | '0';
  if (!has_point || (bytes_no_digits(digits) | bytes_no_digits(before)) != 0) return false;
  const std::uint64_t mantissa = number_of_digits(before) * 100'000'000 + number_of_digits(digits);
  magnitude = static_cast<double>(static_cast<std::int64_t>(mantissa)) / exact_powers_of_ten[decimals];
  return true;
}

}  // namespace

Digits read_number(std::string_view text, char point, double& value) {
  text = bare(text);
  if (text.empty() || says_missing(text)) return Digits::empty;
  if (text.size() > longest) return Digits::not_a_number;
  if (text.front() == '+' && text.size() > 1 && text[1] != '-') text.remove_prefix(1);
  double read = 0.0;
  const auto [end, error] =
      fast_float::from_chars_advanced(text.data(), text.data() + text.size(), read,
                                      fast_float::parse_options{fast_float::chars_format::general, point});
  if (end != text.data() + text.size() || error == std::errc::invalid_argument) return Digits::not_a_number;
  if (!std::isfinite(read)) {
    const char first = text[text.front() == '-' ? 1 : 0];
    return first == point || (first >= '0' && first <= '9') ? Digits::out_of_range : Digits::not_finite;
  }
  value = read;
  return Digits::number;
}

bool read_long_decimal(const char* text, const char* end, char point, bool negative, double& value) {
  double magnitude = 0;
  if (!read_sixteen(text, end, point, magnitude)) {
    if (*text == '-' || end - text >= static_cast<std::ptrdiff_t>(longest)) return false;
    const auto read = fast_float::from_chars_advanced(
        text, end, magnitude, fast_float::parse_options{fast_float::chars_format::general, point});
    if (read.ptr != end || read.ec == std::errc::invalid_argument || !std::isfinite(magnitude)) return false;
  }
  value = signed_number(magnitude, negative);
  return true;
}

bool is_number(std::string_view text) {
  double value = 0.0;
  return read_number(text, '.', value) == Digits::number || read_number(text, ',', value) == Digits::number;
}

std::string shortened(std::string_view text) {
  constexpr std::size_t shown = 40;
  std::string out;
  for (const char c : text.substr(0, shown)) out += static_cast<unsigned char>(c) < ' ' ? '?' : c;
  return text.size() > shown ? out + "..." : out;
}

}  // namespace spoolflow::recording
