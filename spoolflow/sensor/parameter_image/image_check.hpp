#pragma once
/// An image of parameters looked at from its first byte to its last, at once or in slices between samples: the same
/// code checks a page before it is used and watches it afterwards.
#include "spoolflow/sensor/basis/compiler.hpp"
#include "spoolflow/sensor/parameter_image/image_header.hpp"
#include "spoolflow/sensor/parameter_image/image_refusal.hpp"

namespace spoolflow::sensor {

namespace detail {

/// What each half byte leaves of CRC-32 (IEEE 802.3, as of zlib): 64 bytes of flash instead of a kilobyte.
inline constexpr std::uint32_t crc32_rests[16] = {
    0x00000000U, 0x1DB71064U, 0x3B6E20C8U, 0x26D930ACU, 0x76DC4190U, 0x6B6B51F4U, 0x4DB26158U, 0x5005713CU,
    0xEDB88320U, 0xF00F9344U, 0xD6D6A3E8U, 0xCB61B38CU, 0x9B64C2B0U, 0x86D3D2D4U, 0xA00AE278U, 0xBDBDF21CU};

constexpr std::uint32_t crc32_with(std::uint32_t rest, std::uint32_t word) {
  rest ^= word;
  for (int half_byte = 0; half_byte < 8; ++half_byte) rest = crc32_rests[rest & 0xFU] ^ (rest >> 4U);
  return rest;
}

/// Whether the bits are those of a float that is infinite or none.
constexpr bool is_endless(std::uint32_t bits) {
  return (bits & 0x7F800000U) == 0x7F800000U;
}

/// Whether a text of the header ends within its field.
template <std::size_t Room>
constexpr bool ends(const char (&text)[Room]) {
  return text[Room - 1] == '\0';
}

/// A word of an image, whatever it means there.
inline std::uint32_t word_at(const void* image, std::uint32_t index) {
  return word_from(static_cast<const unsigned char*>(image) + sizeof(std::uint32_t) * index);
}

constexpr bool begins_as_image(const ImageHeader& header) {
  for (std::size_t k = 0; k < sizeof image_magic; ++k) {
    if (header.magic[k] != image_magic[k]) return false;
  }
  return true;
}

}  // namespace detail

/// How far an image has been looked at. 20 bytes on a machine of 32 bits; {} is before begin().
struct ImageCheck {
  const ImageHeader* header;
  std::uint32_t words;  ///< that the image has
  std::uint32_t next;   ///< to be looked at
  std::uint32_t rest;   ///< of the CRC-32
  bool endless;         ///< a number that is infinite or none came by
};

/// Begins at the image's first byte with what its header must say before anything else of it counts: a few hundred
/// instructions. `size`: of the page [bytes], of which the image may be the beginning. `none`: go on with advance().
inline ImageRefusal begin(ImageCheck& check, const void* image, std::size_t size) {
  check = {};
  if (image == nullptr || size < sizeof(ImageHeader)) return ImageRefusal::too_short;
  if (reinterpret_cast<std::uintptr_t>(image) % image_alignment != 0) return ImageRefusal::misaligned;
  const ImageHeader& header = *static_cast<const ImageHeader*>(image);
  if (!detail::begins_as_image(header)) return ImageRefusal::no_image;
  if (header.byte_order != image_byte_order) return ImageRefusal::other_byte_order;
  if (header.layout_version != image_layout_version) return ImageRefusal::other_layout;
  if (header.scalar != image_scalar_float) return ImageRefusal::other_scalar;
  if (header.header_bytes != image_header_bytes || header.total_bytes < image_header_bytes ||
      header.total_bytes % image_table_alignment != 0)
    return ImageRefusal::wrong_sizes;
  if (header.total_bytes > size) return ImageRefusal::too_short;
  check.header = &header;
  check.words = header.total_bytes / sizeof(std::uint32_t);  // kept: the page may become anything meanwhile
  check.rest = 0xFFFFFFFFU;
  return ImageRefusal::none;
}

/// Looks at so many more words of four bytes, or at what is left: 57 instructions a word on a Cortex-M4F. True once the
/// end is reached; more calls change nothing.
inline bool advance(ImageCheck& check, std::uint32_t words) {
  constexpr std::uint32_t header_words = image_header_bytes / sizeof(std::uint32_t);
  const std::uint32_t left = check.words - check.next;
  const std::uint32_t end = check.next + (words < left ? words : left);
  for (; check.next < end; ++check.next) {
    if (check.next == header_words - 1U) continue;  // the sum itself
    const std::uint32_t word = detail::word_at(check.header, check.next);
    check.rest = detail::crc32_with(check.rest, word);
    check.endless = check.endless || (check.next >= header_words && detail::is_endless(word));
  }
  return check.next == check.words;
}

/// What was found, once advance() has said that it is through.
inline ImageRefusal found(const ImageCheck& check) {
  if (check.header == nullptr || check.next != check.words) return ImageRefusal::check_unfinished;
  if (~check.rest != check.header->crc32) return ImageRefusal::damaged;
  return check.endless ? ImageRefusal::not_finite : ImageRefusal::none;
}

}  // namespace spoolflow::sensor
