#pragma once
/// Text eight bytes at a time: the first of them in the lowest byte of a word.
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace spoolflow::recording {

/// Bytes after the last line that stepping may look at (not use).
inline constexpr std::size_t scan_padding = 64;

inline std::uint64_t eight_bytes(const char* text) {
  std::uint64_t word;
  std::memcpy(&word, text, sizeof word);
  if constexpr (std::endian::native == std::endian::big) word = __builtin_bswap64(word);
  return word;
}

/// The same letter in each byte.
constexpr std::uint64_t eight_times(unsigned char letter) {
  return std::uint64_t{0x0101010101010101} * letter;
}

/// The top bit of each byte of `word` that equals `letter`.
inline std::uint64_t bytes_equal(std::uint64_t word, char letter) {
  constexpr std::uint64_t low = eight_times(0x7F);
  const std::uint64_t difference = word ^ eight_times(static_cast<unsigned char>(letter));
  return ~(((difference & low) + low) | difference | low);
}

/// The top bit of each byte of `word` that is none of 0 to 9.
inline std::uint64_t bytes_no_digits(std::uint64_t word) {
  const std::uint64_t difference = word ^ eight_times('0');  // of digits 0 to 9
  return (((difference & eight_times(0x7F)) + eight_times(0x7F - 9)) | difference) & eight_times(0x80);
}

/// The marks of bytes, which are their top bits, as eight bits, the first byte's the lowest.
inline std::uint64_t gathered_marks(std::uint64_t marks) {
  return (marks >> 7) * 0x0102'0408'1020'4080 >> 56;
}

/// The number that eight digits stand for, the first in the lowest byte; a byte of 0 counts as the digit 0. Neighbours
/// are joined to numbers of two digits, these to four and to eight, all at once.
inline std::uint64_t number_of_digits(std::uint64_t digits) {
  digits &= eight_times(0x0F);
  digits = 10 * digits + (digits >> 8);  // in bytes 0, 2, 4, 6
  constexpr std::uint64_t pairs = 0x0000'00FF'0000'00FF;
  constexpr std::uint64_t first_and_third = 100 + (std::uint64_t{1'000'000} << 32);
  constexpr std::uint64_t second_and_fourth = 1 + (std::uint64_t{10'000} << 32);
  return ((digits & pairs) * first_and_third + (digits >> 16 & pairs) * second_and_fourth) >> 32;
}

}  // namespace spoolflow::recording
