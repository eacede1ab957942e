#pragma once
/// Steps over the cells of a CSV line eight bytes at a time.
#include <bit>
#include <cstdint>

#include "spoolflow/recording/files/eight_bytes.hpp"

namespace spoolflow::recording {

/// Behind the `cells`-th delimiter from `text` on, or nullptr where the line ends before.
inline const char* behind_delimiters(const char* text, char delimiter, std::size_t cells) {
  for (;; text += 8) {
    const std::uint64_t word = eight_bytes(text);
    std::uint64_t found = bytes_equal(word, delimiter);
    const std::uint64_t line_end = bytes_equal(word, '\n');
    if (line_end != 0) found &= line_end - 1;
    const auto count = marked_bytes(found);
    if (count >= cells) {
      for (; cells > 1; --cells) found &= found - 1;
      return text + std::countr_zero(found) / 8 + 1;
    }
    if (line_end != 0) return nullptr;
    cells -= count;
  }
}

/// The line feed that ends the line, and the delimiters before it.
struct LineRest {
  const char* line_feed;
  std::size_t delimiters;
};
inline LineRest rest_of_line(const char* text, char delimiter) {
  for (std::size_t delimiters = 0;; text += 8) {
    const std::uint64_t word = eight_bytes(text);
    std::uint64_t found = bytes_equal(word, delimiter);
    const std::uint64_t line_end = bytes_equal(word, '\n');
    if (line_end != 0) {
      found &= line_end - 1;
      return {text + std::countr_zero(line_end) / 8, delimiters + marked_bytes(found)};
    }
    delimiters += marked_bytes(found);
  }
}

}  // namespace spoolflow::recording
