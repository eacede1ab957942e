#pragma once
/// Steps over the cells of a CSV line eight bytes at a time.
#include <bit>
#include <cstdint>
#include <cstring>

namespace spoolflow::recording {

/// Bytes after the last line that stepping may look at (not use).
inline constexpr std::size_t scan_padding = 16;

/// The top bit of each byte of `word` that equals `letter`.
inline std::uint64_t bytes_equal(std::uint64_t word, char letter) {
  constexpr std::uint64_t ones = 0x0101010101010101u;
  constexpr std::uint64_t low = 0x7F7F7F7F7F7F7F7Fu;
  const std::uint64_t difference = word ^ (ones * static_cast<unsigned char>(letter));
  return ~(((difference & low) + low) | difference | low);
}

inline std::uint64_t eight_bytes(const char* text) {
  std::uint64_t word;
  std::memcpy(&word, text, sizeof word);
  if constexpr (std::endian::native == std::endian::big) word = __builtin_bswap64(word);
  return word;
}

/// Behind the `cells`-th delimiter from `text` on, or nullptr where the line ends before.
inline const char* behind_delimiters(const char* text, char delimiter, std::size_t cells) {
  for (;; text += 8) {
    const std::uint64_t word = eight_bytes(text);
    std::uint64_t found = bytes_equal(word, delimiter);
    const std::uint64_t line_end = bytes_equal(word, '\n');
    if (line_end != 0) found &= line_end - 1;
    const auto count = static_cast<std::size_t>(std::popcount(found));
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
      return {text + std::countr_zero(line_end) / 8, delimiters + static_cast<std::size_t>(std::popcount(found))};
    }
    delimiters += static_cast<std::size_t>(std::popcount(found));
  }
}

}  // namespace spoolflow::recording
