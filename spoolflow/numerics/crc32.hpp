#pragma once
#include <array>
#include <cstdint>
#include <span>

namespace spoolflow::numerics {

namespace detail {

/// What each byte leaves.
inline constexpr auto crc32_rests = [] {
  std::array<std::uint32_t, 256> out{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t rest = byte;
    for (int bit = 0; bit < 8; ++bit) rest = (rest & 1U) != 0 ? 0xEDB88320U ^ (rest >> 1U) : rest >> 1U;
    out[byte] = rest;
  }
  return out;
}();

}  // namespace detail

/// CRC-32 of IEEE 802.3, as zlib's and most microcontrollers' peripherals reckon it: polynomial 0x04C11DB7, reflected,
/// begun and ended with all ones. It tells damage and mix-ups, not forgery.
constexpr std::uint32_t crc32(std::span<const std::uint8_t> bytes) {
  std::uint32_t rest = 0xFFFFFFFFU;
  for (const std::uint8_t byte : bytes) rest = detail::crc32_rests[(rest ^ byte) & 0xFFU] ^ (rest >> 8U);
  return ~rest;
}

}  // namespace spoolflow::numerics
