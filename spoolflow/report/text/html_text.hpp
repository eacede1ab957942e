#pragma once
#include <array>
#include <string>
#include <string_view>

namespace spoolflow::report {

/// Text with the characters that mean something in HTML written as entities.
[[nodiscard]] inline std::string html_text(std::string_view text) {
  constexpr std::string_view letters = "&<>\"";
  constexpr std::array entities{"&amp;", "&lt;", "&gt;", "&quot;"};
  std::string out;
  for (const char c : text) {
    const std::size_t at = letters.find(c);
    out += at == std::string_view::npos ? std::string(1, c) : entities[at];
  }
  return out;
}

}  // namespace spoolflow::report
