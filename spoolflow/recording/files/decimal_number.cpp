#include "spoolflow/recording/files/decimal_number.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fast_float/fast_float.h>
#include <system_error>

namespace spoolflow::recording {
namespace {

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
  constexpr std::array<std::string_view, 10> words{"nan",  "null", "-",   "na",   "n/a",
                                                   "#n/a", "--",   "---", "none", "1.#qnan"};
  constexpr std::size_t longest = 8;
  if (text.size() > longest) return false;
  std::array<char, longest> small{};
  std::ranges::transform(text, small.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return std::ranges::count(words, std::string_view(small.data(), text.size())) > 0;
}

}  // namespace

Digits read_number(std::string_view text, char point, double& value) {
  text = bare(text);
  if (text.empty() || says_missing(text)) return Digits::empty;
  constexpr std::size_t longest = 400;  // no number of a recording is longer
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

bool is_number(std::string_view text) {
  double value = 0.0;
  return read_number(text, '.', value) == Digits::number || read_number(text, ',', value) == Digits::number;
}

}  // namespace spoolflow::recording
