#include "spoolflow/recording/mdf4/mdf4_conversion.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

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

namespace {

constexpr int deepest = 2;  // of conversions within conversions
constexpr const char* texts = "texts in the place of numbers";

}  // namespace

Mdf4Conversion::Mdf4Conversion(const FileBytes& file, std::uint64_t at) : Mdf4Conversion(file, at, 0) {}

Mdf4Conversion::Mdf4Conversion(const FileBytes& file, std::uint64_t at, int depth) {
  const Mdf4Block block = read_block(file, at, "##CC");
  ByteReader bytes = block.reader();
  const std::uint8_t kind = bytes.u8();
  bytes.skip(1 + 2 + 2);  // precision, flags, number of links
  const std::uint16_t count = bytes.u16();
  bytes.skip(2 * sizeof(double));  // range of values
  unit_ = read_text(file, block.link(1));
  if (kind == static_cast<std::uint8_t>(Kind::formula)) {
    unread_ = "numbers that a formula converts";
  } else if (kind > static_cast<std::uint8_t>(Kind::texts_of_ranges)) {
    unread_ = texts;
  }
  if (!unread_.empty()) return;
  kind_ = static_cast<Kind>(kind);
  for (std::uint16_t k = 0; k < count; ++k) numbers_.push_back(bytes.f64());
  check(block.what);
  if (kind_ == Kind::texts_of_values) read_texts(file, block, numbers_.size(), depth);
  if (kind_ == Kind::texts_of_ranges) read_texts(file, block, numbers_.size() / 2, depth);
}

/// Entries are texts or conversions, behind them that of all other numbers.
void Mdf4Conversion::read_texts(const FileBytes& file, const Mdf4Block& block, std::size_t count, int depth) {
  constexpr std::size_t before = 4;  // links that every conversion has
  constexpr std::size_t most = 16;   // conversions
  std::map<std::uint64_t, int> known;
  for (std::size_t k = 0; k <= count; ++k) {
    const std::uint64_t at = block.link(before + k);
    answers_.push_back(known.contains(at) ? known[at] : -1);
    if (at == 0 || known.contains(at) || read_head(file, at).id != "##CC") continue;
    if (depth == deepest || inner_.size() == most) {
      unread_ = "numbers that many tables within tables convert";
      return;
    }
    inner_.push_back(Mdf4Conversion(file, at, depth + 1));
    const Mdf4Conversion& inner = inner_.back();
    if (unit_.empty()) unit_ = inner.unit();
    if (inner.unread().empty()) {
      answers_.back() = static_cast<int>(inner_.size()) - 1;
    } else if (inner.unread() != texts) {
      unread_ = inner.unread();
      return;
    }
    known.emplace(at, answers_.back());
  }
  if (std::ranges::all_of(answers_, [](int answer) { return answer < 0; })) unread_ = texts;
}

void Mdf4Conversion::check(const std::string& what) const {
  const std::size_t count = numbers_.size();
  const bool fits = kind_ == Kind::identity ||                                                           //
                    (kind_ == Kind::linear && count >= 2) || (kind_ == Kind::rational && count >= 6) ||  //
                    (kind_ == Kind::ranges && count % 3 == 1) || kind_ == Kind::texts_of_values ||
                    (kind_ == Kind::texts_of_ranges && count % 2 == 0) ||
                    ((kind_ == Kind::interpolated || kind_ == Kind::nearest) && count >= 2 && count % 2 == 0);
  if (!fits) refuse_mdf4(what, fmt::format("its conversion has {} numbers", count));
  if (kind_ != Kind::interpolated && kind_ != Kind::nearest) return;
  for (std::size_t k = 2; k < count; k += 2) {
    if (!(numbers_[k] > numbers_[k - 2])) refuse_mdf4(what, "the keys of its table do not rise");
  }
}

double Mdf4Conversion::of_pairs(double raw) const {
  const std::size_t pairs = numbers_.size() / 2;
  std::size_t above = 0;
  for (std::size_t step = pairs; step > 0;) {  // how many keys lie below
    const std::size_t half = step / 2;
    if (numbers_[2 * (above + half)] < raw) {
      above += half + 1;
      step -= half + 1;
    } else {
      step = half;
    }
  }
  if (above == 0) return numbers_[1];
  if (above == pairs) return numbers_[2 * pairs - 1];
  const double low = numbers_[2 * above - 2], high = numbers_[2 * above];
  const double at_low = numbers_[2 * above - 1], at_high = numbers_[2 * above + 1];
  if (kind_ == Kind::nearest) return raw - low > high - raw ? at_high : at_low;
  return at_low + (at_high - at_low) * (raw - low) / (high - low);
}

double Mdf4Conversion::of_ranges(double raw, bool whole) const {
  for (std::size_t k = 0; k + 3 < numbers_.size(); k += 3) {
    if (raw >= numbers_[k] && (raw < numbers_[k + 1] || (whole && raw == numbers_[k + 1]))) return numbers_[k + 2];
  }
  return numbers_.back();
}

double Mdf4Conversion::of_texts(double raw, bool whole) const {
  const bool ranges = kind_ == Kind::texts_of_ranges;
  const std::size_t entries = answers_.size() - 1;
  std::size_t entry = 0;
  for (; entry < entries; ++entry) {
    const double low = numbers_[ranges ? 2 * entry : entry], high = ranges ? numbers_[2 * entry + 1] : low;
    if (raw >= low && (raw < high || (raw == high && (whole || !ranges)))) break;
  }
  const int answer = answers_[entry];
  return answer < 0 ? NAN : inner_[static_cast<std::size_t>(answer)].value_at(raw, whole);
}

double Mdf4Conversion::value_at(double raw, bool whole) const {
  const std::vector<double>& p = numbers_;
  switch (kind_) {
    case Kind::linear:
      return p[0] + p[1] * raw;
    case Kind::rational:
      return ((p[0] * raw + p[1]) * raw + p[2]) / ((p[3] * raw + p[4]) * raw + p[5]);
    case Kind::interpolated:
    case Kind::nearest:
      return of_pairs(raw);
    case Kind::ranges:
      return of_ranges(raw, whole);
    case Kind::texts_of_values:
    case Kind::texts_of_ranges:
      return of_texts(raw, whole);
    default:
      return raw;
  }
}

void Mdf4Conversion::apply(double* values, std::size_t count, bool whole) const {
  if (kind_ == Kind::identity) return;
  for (std::size_t k = 0; k < count; ++k) {
    if (!std::isnan(values[k])) values[k] = value_at(values[k], whole);
  }
}

}  // namespace spoolflow::recording
