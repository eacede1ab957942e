#include "spoolflow/recording/mdf4/mdf4_sample.hpp"

#include <cmath>

namespace spoolflow::recording {
namespace {

/// The bits as a whole number: up to 64 in up to nine bytes, of which the first one holds the lowest or the highest.
std::uint64_t packed_bits(const Mdf4Sample& sample, const std::uint8_t* from) {
  const std::uint32_t bytes = sample.span();
  const bool turned = sample.number.order == ByteOrder::highest_first;
  std::uint64_t out = 0;
  for (std::uint32_t k = 0; k < bytes; ++k) {
    const std::uint64_t byte = from[turned ? bytes - 1 - k : k];
    const int shift = static_cast<int>(8 * k) - static_cast<int>(sample.bit);
    out |= shift >= 0 ? byte << static_cast<unsigned>(shift) : byte >> static_cast<unsigned>(-shift);
  }
  return sample.bits == 64 ? out : out & ((std::uint64_t{1} << sample.bits) - 1);
}

}  // namespace

double Mdf4Sample::read(const std::uint8_t* record, std::uint64_t index) const {
  if (invalid_bit && (record[*invalid_bit / 8] >> (*invalid_bit % 8) & 1U) != 0) return NAN;
  if (by_index) return static_cast<double>(index);
  const std::uint8_t* const from = record + byte;
  if (number.kind == StoredNumber::Kind::real) {
    double out = 0;
    read_numbers(number, from, 0, 1, &out);
    return out;
  }
  const std::uint64_t value = packed_bits(*this, from);
  if (number.kind == StoredNumber::Kind::unsigned_whole) return static_cast<double>(value);
  const unsigned above = 64 - bits;
  return static_cast<double>(static_cast<std::int64_t>(value << above) >> above);
}

std::optional<Mdf4Sample> mdf4_sample(std::uint8_t type, std::uint32_t byte, std::uint8_t bit, std::uint32_t bits,
                                      std::string& unread) {
  using Kind = StoredNumber::Kind;
  constexpr std::uint8_t last_of_numbers = 5, last_of_texts = 9;
  if (type > last_of_numbers) {
    unread = type <= last_of_texts ? "text" : "what is no single number";
    return std::nullopt;
  }
  Mdf4Sample out;
  out.number.kind = type < 2 ? Kind::unsigned_whole : type < 4 ? Kind::signed_whole : Kind::real;
  out.number.order = type % 2 == 0 ? ByteOrder::lowest_first : ByteOrder::highest_first;
  out.number.bytes = static_cast<std::uint8_t>(bits / 8);
  out.byte = byte, out.bit = bit, out.bits = bits;
  const bool real = out.number.kind == Kind::real;
  const bool fits = real ? bit == 0 && (bits == 16 || bits == 32 || bits == 64) : bit < 8 && bits >= 1 && bits <= 64;
  if (fits) return out;
  unread = "numbers of a width that is not known";
  return std::nullopt;
}

}  // namespace spoolflow::recording
