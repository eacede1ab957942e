#include "spoolflow/recording/bytes/stored_number.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace spoolflow::recording {
namespace {

static_assert(std::endian::native == std::endian::little, "the files' usual byte order is taken as it stands");

template <class Number, bool turned>
void read_as(const std::uint8_t* from, std::size_t stride, std::size_t count, double* out) {
  for (std::size_t k = 0; k < count; ++k, from += stride) {
    std::array<std::uint8_t, sizeof(Number)> bytes;
    std::memcpy(bytes.data(), from, sizeof(Number));
    if constexpr (turned) std::reverse(bytes.begin(), bytes.end());
    out[k] = static_cast<double>(std::bit_cast<Number>(bytes));
  }
}

template <bool turned>
void read_in_order(const StoredNumber& stored, const std::uint8_t* from, std::size_t stride, std::size_t count,
                   double* out) {
  using Kind = StoredNumber::Kind;
  if (stored.kind == Kind::real) {
    return stored.bytes == 4 ? read_as<float, turned>(from, stride, count, out)
                             : read_as<double, turned>(from, stride, count, out);
  }
  const bool is_signed = stored.kind == Kind::signed_whole;
  switch (stored.bytes) {
    case 1:
      return is_signed ? read_as<std::int8_t, turned>(from, stride, count, out)
                       : read_as<std::uint8_t, turned>(from, stride, count, out);
    case 2:
      return is_signed ? read_as<std::int16_t, turned>(from, stride, count, out)
                       : read_as<std::uint16_t, turned>(from, stride, count, out);
    case 4:
      return is_signed ? read_as<std::int32_t, turned>(from, stride, count, out)
                       : read_as<std::uint32_t, turned>(from, stride, count, out);
    default:
      return is_signed ? read_as<std::int64_t, turned>(from, stride, count, out)
                       : read_as<std::uint64_t, turned>(from, stride, count, out);
  }
}

}  // namespace

void read_numbers(const StoredNumber& stored, const std::uint8_t* from, std::size_t stride, std::size_t count,
                  double* out) {
  if (stored.order == ByteOrder::highest_first) {
    read_in_order<true>(stored, from, stride, count, out);
  } else {
    read_in_order<false>(stored, from, stride, count, out);
  }
}

}  // namespace spoolflow::recording
