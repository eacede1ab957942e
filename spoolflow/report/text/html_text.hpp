#pragma once
#include <string>
#include <string_view>

namespace spoolflow::report {

/// Text with the characters that mean something in HTML written as entities.
[[nodiscard]] inline std::string html_text(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

}  // namespace spoolflow::report
