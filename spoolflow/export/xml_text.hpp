#pragma once
#include <string>
#include <string_view>

namespace spoolflow::exports {

/// Text for an attribute or an element of XML and HTML; characters that XML does not allow become spaces.
inline std::string xml_text(std::string_view text) {
  std::string out;
  for (const char letter : text) {
    switch (letter) {
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
        out += static_cast<unsigned char>(letter) < 0x20 ? ' ' : letter;
    }
  }
  return out;
}

}  // namespace spoolflow::exports
