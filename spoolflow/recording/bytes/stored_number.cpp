#include "spoolflow/recording/bytes/stored_number.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
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

/// IEEE 754 binary16: 1 bit of sign, 5 of the exponent, 10 of the fraction.
double from_half(std::uint16_t bits) {
  constexpr int bias = 15, fraction_bits = 10, largest = 31;
  const int exponent = bits >> fraction_bits & largest;
  const double fraction = bits & 0x3FF;
  double out = 0;
  if (exponent == largest) {
    out = fraction == 0 ? INFINITY : NAN;
  } else if (exponent == 0) {
    out = std::ldexp(fraction, 1 - bias - fraction_bits);
  } else {
    out = std::ldexp(0x400 + fraction, exponent - bias - fraction_bits);
  }
  return (bits & 0x8000) != 0 ? -out : out;
}

template <bool turned>
void read_halves(const std::uint8_t* from, std::size_t stride, std::size_t count, double* out) {
  read_as<std::uint16_t, turned>(from, stride, count, out);
  for (std::size_t k = 0; k < count; ++k) out[k] = from_half(static_cast<std::uint16_t>(out[k]));
}

template <bool turned>
void read_in_order(const StoredNumber& stored, const std::uint8_t* from, std::size_t stride, std::size_t count,
                   double* out) {
  using Kind = StoredNumber::Kind;
  if (stored.kind == Kind::real) {
    if (stored.bytes == 2) return read_halves<turned>(from, stride, count, out);
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
