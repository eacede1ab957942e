#pragma once
/// Where the cells of CSV lines end, found for 64 bytes at once: where a cell begins then waits for no number before
/// it.
#include <bit>
#include <cstdint>
#include <cstring>

#include "spoolflow/recording/files/eight_bytes.hpp"

namespace spoolflow::recording {

/// Those of 64 bytes that are a delimiter or a line feed, the first in the lowest bit.
inline std::uint64_t ends_in_64_bytes(const char* text, char delimiter) {
  std::uint64_t out = 0;
#if defined(__SSE2__)
  using Bytes [[gnu::vector_size(16)]] = char;
  const Bytes delimiters = Bytes{} + delimiter, line_feeds = Bytes{} + '\n';
  for (unsigned k = 0; k < 64; k += 16) {
    Bytes bytes;
    std::memcpy(&bytes, text + k, sizeof bytes);
    const auto ends = reinterpret_cast<Bytes>((bytes == delimiters) | (bytes == line_feeds));
    out |= static_cast<std::uint64_t>(static_cast<std::uint32_t>(__builtin_ia32_pmovmskb128(ends))) << k;
  }
#else
  for (unsigned k = 0; k < 64; k += 8) {
    const std::uint64_t word = eight_bytes(text + k);
    out |= gathered_marks(bytes_equal(word, delimiter) | bytes_equal(word, '\n')) << k;
  }
#endif
  return out;
}

/// The ends of cells from a line's beginning on. Behind the last line feed there is scan_padding.
class CellEnds {
 public:
  CellEnds(const char* line, char delimiter)
      : window_(line), ends_(ends_in_64_bytes(line, delimiter)), delimiter_(delimiter) {}

  /// A delimiter or a line feed; not to be asked for behind the last.
  const char* next() {
    while (ends_ == 0) [[unlikely]] {
        window_ += 64;
        ends_ = ends_in_64_bytes(window_, delimiter_);
      }
    const char* const end = window_ + std::countr_zero(ends_);
    ends_ &= ends_ - 1;
    return end;
  }

 private:
  const char* window_;
  std::uint64_t ends_;
  char delimiter_;
};

}  // namespace spoolflow::recording
