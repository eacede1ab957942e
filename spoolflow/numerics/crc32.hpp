#pragma once
#include <array>
#include <cstdint>
#include <span>

namespace spoolflow::numerics {

namespace detail {

/// What each byte leaves, and what it leaves with one to seven zero bytes behind: eight bytes are taken at a time.
inline constexpr auto crc32_rests = [] {
  std::array<std::array<std::uint32_t, 256>, 8> tables{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t rest = byte;
    for (int bit = 0; bit < 8; ++bit) rest = (rest & 1U) != 0 ? 0xEDB88320U ^ (rest >> 1U) : rest >> 1U;
    tables[0][byte] = rest;
  }
  for (std::size_t zeros = 1; zeros < tables.size(); ++zeros) {
    for (std::size_t byte = 0; byte < 256; ++byte) {
      const std::uint32_t before = tables[zeros - 1][byte];
      tables[zeros][byte] = tables[0][before & 0xFFU] ^ (before >> 8U);
    }
  }
  return tables;
}();

/// Of the first four bytes.
constexpr std::uint32_t little_endian_number(std::span<const std::uint8_t> bytes) {
  return bytes[0] | std::uint32_t{bytes[1]} << 8U | std::uint32_t{bytes[2]} << 16U | std::uint32_t{bytes[3]} << 24U;
}

}  // namespace detail

/// CRC-32 of IEEE 802.3, as zlib's and most microcontrollers' peripherals compute it: polynomial 0x04C11DB7, reflected,
/// begun and ended with all ones. It detects damage and mix-ups, not forgery.
constexpr std::uint32_t crc32(std::span<const std::uint8_t> bytes) {
  std::uint32_t rest = 0xFFFFFFFFU;
  const auto part = [](std::size_t zeros, std::uint32_t byte) { return detail::crc32_rests[zeros][byte & 0xFFU]; };
  for (; bytes.size() >= 8; bytes = bytes.subspan(8)) {
    const std::uint32_t low = rest ^ detail::little_endian_number(bytes);
    const std::uint32_t high = detail::little_endian_number(bytes.subspan(4));
    rest = part(7, low) ^ part(6, low >> 8U) ^ part(5, low >> 16U) ^ part(4, low >> 24U) ^ part(3, high) ^
           part(2, high >> 8U) ^ part(1, high >> 16U) ^ part(0, high >> 24U);
  }
  for (const std::uint8_t byte : bytes) rest = part(0, rest ^ byte) ^ (rest >> 8U);
  return ~rest;
}

}  // namespace spoolflow::numerics
