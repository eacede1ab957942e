#pragma once
/// Whole numbers as bytes, the lowest first.
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace spoolflow::numerics {

/// The unsigned number of type N at byte `at`; all its bytes must be there.
template <class N>
[[nodiscard]] N little_endian(std::span<const std::uint8_t> bytes, std::size_t at) {
  N value = 0;
  for (std::size_t k = sizeof(N); k-- > 0;) value = static_cast<N>((value << 4U) << 4U) | static_cast<N>(bytes[at + k]);
  return value;
}

/// Appends the bytes of an unsigned number.
template <class N>
void put_little_endian(std::vector<std::uint8_t>& bytes, N value) {
  for (std::size_t k = 0; k < sizeof(N); ++k) {
    bytes.push_back(static_cast<std::uint8_t>(value & 0xFFU));
    value = static_cast<N>((value >> 4U) >> 4U);
  }
}

}  // namespace spoolflow::numerics
