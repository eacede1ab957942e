#pragma once
#include <array>
#include <string>
#include <string_view>

namespace spoolflow::exports {

/// Text for an attribute or an element of XML and HTML; characters that XML does not allow become spaces.
inline std::string xml_text(std::string_view text) {
  constexpr std::string_view letters = "&<>\"";
  constexpr std::array entities{"&amp;", "&lt;", "&gt;", "&quot;"};
  std::string out;
  for (const char c : text) {
    const std::size_t at = letters.find(c);
    out += at == std::string_view::npos ? std::string(1, static_cast<unsigned char>(c) < 0x20 ? ' ' : c) : entities[at];
  }
  return out;
}

}  // namespace spoolflow::exports
