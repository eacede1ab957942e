#pragma once
#include <string_view>

namespace spoolflow::recording {

/// Text in UTF-8 less the mark that some programs write before it.
[[nodiscard]] constexpr std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  return text.starts_with(mark) ? text.substr(mark.size()) : text;
}

}  // namespace spoolflow::recording
