#pragma once
/// Text in UTF-8, a character at a time (RFC 3629).
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace spoolflow::recording {

struct Utf8Character {
  std::size_t bytes;   ///< 0: no character of UTF-8 begins here
  std::uint32_t code;  ///< then that of the first byte
};
/// The first character of a text that is not empty.
[[nodiscard]] Utf8Character first_character(std::string_view text);

void append_utf8(std::string& out, std::uint32_t code);

}  // namespace spoolflow::recording
