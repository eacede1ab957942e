#pragma once
#include <array>
#include <charconv>
#include <string>

namespace spoolflow::exports::fmu {

/// The shortest decimal that means the same number, whatever the locale says; "NaN" and "INF" as XML writes them.
inline std::string number_text(double value) {
  if (value != value) return "NaN";
  if (value - value != 0) return value > 0 ? "INF" : "-INF";
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

}  // namespace spoolflow::exports::fmu
