#include "spoolflow/recording/files/decimal_number.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>

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

/// The order of magnitude is negative: the exponent, or a mantissa that begins with 0 and a decimal point.
bool is_tiny(std::string_view digits) {
  const std::size_t exponent = digits.find_first_of("eE");
  return exponent != std::string_view::npos ? digits.substr(exponent + 1).starts_with('-') : true;
}

}  // namespace

Digits read_number(std::string_view text, char point, double& value) {
  text = bare(text);
  if (text.empty()) return Digits::empty;
  constexpr std::size_t longest = 400;  // no number of a recording is longer
  if (text.size() > longest) return Digits::not_a_number;
  if (text.front() == '+' && text.size() > 1 && text[1] != '-') text.remove_prefix(1);
  std::string pointed;
  if (point != '.') {
    if (text.find('.') != std::string_view::npos) return Digits::not_a_number;
    pointed = text;
    std::replace(pointed.begin(), pointed.end(), point, '.');
    text = pointed;
  }
  double read = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), read);
  if (end != text.data() + text.size() || error == std::errc::invalid_argument) return Digits::not_a_number;
  if (error == std::errc::result_out_of_range) {
    if (!is_tiny(text)) return Digits::out_of_range;
    read = text.front() == '-' ? -0.0 : 0.0;
  }
  if (!std::isfinite(read)) return Digits::not_finite;
  value = read;
  return Digits::number;
}

}  // namespace spoolflow::recording
