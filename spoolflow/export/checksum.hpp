#pragma once
/// Sums over bytes that tell damage and mix-ups, not forgery: FNV-1a, and the CRC that firmware has anyway.
#include <cstddef>
#include <cstdint>

namespace spoolflow::exports {

class Checksum {
 public:
  constexpr void add(const char* bytes, std::size_t size) {
    for (std::size_t k = 0; k < size; ++k) value_ = (value_ ^ static_cast<unsigned char>(bytes[k])) * 0x100000001b3ULL;
  }
  [[nodiscard]] constexpr std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

constexpr std::uint64_t checksum(const char* bytes, std::size_t size) {
  Checksum sum;
  sum.add(bytes, size);
  return sum.value();
}

/// CRC-32 of IEEE 802.3, as zlib's and most microcontrollers' peripherals reckon it.
constexpr std::uint32_t crc32(const char* bytes, std::size_t size) {
  std::uint32_t sum = 0xFFFFFFFFU;
  for (std::size_t k = 0; k < size; ++k) {
    sum ^= static_cast<unsigned char>(bytes[k]);
    for (int bit = 0; bit < 8; ++bit) sum = (sum >> 1U) ^ ((sum & 1U) != 0 ? 0xEDB88320U : 0U);
  }
  return ~sum;
}

}  // namespace spoolflow::exports
