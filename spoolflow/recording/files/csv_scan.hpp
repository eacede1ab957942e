#pragma once
/// Where the cells of CSV lines end, found for 64 bytes at once: where a cell begins then waits for no number before
/// it.
#include <bit>
#include <cstdint>
#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include "spoolflow/recording/files/eight_bytes.hpp"

namespace spoolflow::recording {

/// Those of 64 bytes that are a delimiter or a line feed, the first in the lowest bit.
inline std::uint64_t ends_in_64_bytes(const char* text, char delimiter) {
  std::uint64_t out = 0;
#if defined(__SSE2__)
  const __m128i delimiters = _mm_set1_epi8(delimiter);
  const __m128i line_feeds = _mm_set1_epi8('\n');
  for (unsigned k = 0; k < 64; k += 16) {
    const __m128i bytes = _mm_loadu_si128(reinterpret_cast<const __m128i*>(text + k));
    const __m128i ends = _mm_or_si128(_mm_cmpeq_epi8(bytes, delimiters), _mm_cmpeq_epi8(bytes, line_feeds));
    out |= static_cast<std::uint64_t>(static_cast<std::uint32_t>(_mm_movemask_epi8(ends))) << k;
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
