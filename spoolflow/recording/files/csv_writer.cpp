#include "spoolflow/recording/files/csv_writer.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <ostream>
#include <utility>

namespace spoolflow::recording {
namespace {

constexpr std::size_t buffer_size = std::size_t{1} << 17;
constexpr std::array<double, 10> power{1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9};
constexpr std::uint64_t eight_places = 100'000'000;
constexpr std::size_t longest_number = 344;  // 309 digits before the point, sign, point, decimals, what else is written

/// The last eight decimal digits of a number below 1e8 as numbers 0 to 9, the first in the lowest byte: halves of four
/// digits, then of two, then of one, each split in all places of the word at once by a product with the inverse.
inline std::uint64_t eight_digits(std::uint64_t number) {
  const std::uint64_t fours = number / 10'000 | number % 10'000 << 32;
  const std::uint64_t hundreds = (fours * 10'486 >> 20) & 0x0000'007F'0000'007F;
  const std::uint64_t twos = hundreds | (fours - 100 * hundreds) << 16;
  const std::uint64_t tens = (twos * 103 >> 10) & 0x000F'000F'000F'000F;
  return tens | (twos - 10 * tens) << 8;
}

/// Eight bytes, of which those that the caller counts are text.
inline void put_eight(char* out, std::uint64_t digits) {
  std::uint64_t text = digits | 0x3030'3030'3030'3030;
  if constexpr (std::endian::native == std::endian::big) text = __builtin_bswap64(text);
  std::memcpy(out, &text, sizeof text);
}

/// The digits of `number`, below 1e16, the last `decimals` <= 7 of them behind a point and at least one before it;
/// returns the end. Writes up to 8 bytes more.
inline char* put_fixed(char* out, std::uint64_t number, unsigned decimals) {
  unsigned most_zeros = 7 - decimals;  // that are left out: leading ones, but for the last before the point
  if (number >= eight_places) {
    const std::uint64_t high = eight_digits(number / eight_places);
    const unsigned zeros = static_cast<unsigned>(std::countr_zero(high)) / 8;
    put_eight(out, high >> 8 * zeros);
    out += 8 - zeros;
    most_zeros = 0;
    number %= eight_places;
  }
  const std::uint64_t digits = eight_digits(number);
  const unsigned leading = static_cast<unsigned>(std::countr_zero(digits | std::uint64_t{1} << 63)) / 8;
  const unsigned zeros = std::min(leading, most_zeros);
  put_eight(out, digits >> 8 * zeros);
  out += 8 - zeros - decimals;
  if (decimals == 0) return out;
  *out = '.';
  put_eight(out + 1, digits >> 8 * (8 - decimals));
  return out + 1 + decimals;
}

/// The numbers below a thousand as text: all three digits, and without leading zeros, behind which stands how many that
/// leaves. 8 KB, half of a number's time.
struct Thousand {
  std::array<std::array<char, 4>, 1000> digits{}, shortest{};
};
constexpr Thousand thousand = [] {
  Thousand out;
  for (unsigned k = 0; k < 1000; ++k) {
    out.digits[k] = {static_cast<char>('0' + k / 100), static_cast<char>('0' + k / 10 % 10),
                     static_cast<char>('0' + k % 10), 0};
    const unsigned length = k < 10 ? 1 : k < 100 ? 2 : 3;
    for (unsigned j = 0; j < length; ++j) out.shortest[k][j] = out.digits[k][3 - length + j];
    out.shortest[k][3] = static_cast<char>(length);
  }
  return out;
}();

inline char* put_three(char* out, std::uint64_t below_thousand) {
  std::memcpy(out, thousand.digits[below_thousand].data(), 4);
  return out + 3;
}
inline char* put_up_to_three(char* out, std::uint64_t below_thousand) {
  const auto& text = thousand.shortest[below_thousand];
  std::memcpy(out, text.data(), 4);
  return out + text[3];
}

constexpr unsigned most_grouped_decimals = 6;
constexpr std::uint64_t grouped_whole = 1'000'000;  // below it

/// As put_fixed, of a number whose part before the point is below `grouped_whole`: three digits at once from a table.
template <unsigned decimals>
inline char* put_grouped(char* out, std::uint64_t number) {
  constexpr auto one = static_cast<std::uint64_t>(power[decimals]);
  const std::uint64_t whole = number / one;
  std::uint64_t fraction = number % one;
  if (whole < 1000) [[likely]] {
    out = put_up_to_three(out, whole);
  } else {
    out = put_three(put_up_to_three(out, whole / 1000), whole % 1000);
  }
  *out++ = '.';
  constexpr unsigned first = std::min(decimals, 3U);
  constexpr auto behind = static_cast<std::uint64_t>(power[decimals - first]);
  put_three(out, fraction / behind * static_cast<std::uint64_t>(power[3 - first]));
  if constexpr (decimals > 3) {
    fraction %= behind;
    put_three(out + 3, fraction * static_cast<std::uint64_t>(power[most_grouped_decimals - decimals]));
  }
  return out + decimals;
}

/// Either, whichever is fit for it.
inline char* put_decimals(char* out, std::uint64_t number, unsigned decimals) {
  if (decimals > most_grouped_decimals || number >= static_cast<std::uint64_t>(power[decimals]) * grouped_whole)
    return put_fixed(out, number, decimals);
  switch (decimals) {
    case 1:
      return put_grouped<1>(out, number);
    case 2:
      return put_grouped<2>(out, number);
    case 3:
      return put_grouped<3>(out, number);
    case 4:
      return put_grouped<4>(out, number);
    case 5:
      return put_grouped<5>(out, number);
    case 6:
      return put_grouped<6>(out, number);
    default:
      return put_fixed(out, number, decimals);
  }
}

/// Nothing where there is no number.
inline char* put_number(char* at, double value, unsigned decimals) {
  const double scaled = std::abs(value) * power[decimals];
  if (scaled < 9e15 && decimals < 8) [[likely]] {
    // NOLINTNEXTLINE(bugprone-incorrect-roundings): lround is a call; ties that a double cannot hold do not matter here
    const auto digits = static_cast<std::int64_t>(scaled + 0.5);
    *at = '-';
    at += static_cast<int>(value < 0) &
          static_cast<int>(digits != 0);  // without a branch: signs of noise come as they like
    return put_decimals(at, static_cast<std::uint64_t>(digits), decimals);
  }
  if (std::isnan(value)) return at;
  return std::to_chars(at, at + longest_number, value, std::chars_format::fixed, static_cast<int>(decimals)).ptr;
}

}  // namespace

CsvWriter::CsvWriter(std::ostream& out) : out_(out), buffer_(buffer_size) {}

CsvWriter::~CsvWriter() {
  try {
    flush();
  } catch (...) {  // the stream keeps its error; whoever commits the file meets it
  }
}

/// Room for so many bytes in one piece.
char* CsvWriter::room(std::size_t bytes) {
  if (buffer_.size() - used_ < bytes) [[unlikely]]
    make_room(bytes);
  return buffer_.data() + used_;
}

void CsvWriter::make_room(std::size_t bytes) {
  flush();
  if (buffer_.size() < bytes) buffer_.resize(bytes);
}

/// Between cells.
char* CsvWriter::separated(char* at) {
  *at = ',';
  return at + (std::exchange(row_begun_, true) ? 1 : 0);
}

void CsvWriter::used_to(const char* end) {
  used_ = static_cast<std::size_t>(end - buffer_.data());
}

void CsvWriter::header(const std::vector<std::string>& names) {
  for (const std::string& name : names) text(name);
  end_row();
}

void CsvWriter::number(double value, int decimals) {
  used_to(put_number(separated(room(longest_number)), value, static_cast<unsigned>(decimals)));
}

void CsvWriter::numbers(std::span<const FixedColumn> columns, std::size_t row) {
  if (columns.empty()) return;
  char* at = separated(room(columns.size() * longest_number));
  for (const FixedColumn& column : columns) {
    at = put_number(at, column.values[row], column.decimals);
    *at++ = ',';
  }
  used_to(at - 1);
}

std::string CsvWriter::cell(std::string_view text) {
  if (text.find_first_of(",\"\n\r") == std::string_view::npos) return std::string(text);
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + '"';
}

void CsvWriter::put(std::string_view cell) {
  char* const at = separated(room(cell.size() + 8));
  std::memcpy(at, cell.data(), cell.size());
  used_to(at + cell.size());
}

void CsvWriter::text(std::string_view text) {
  put(cell(text));
}

void CsvWriter::end_row() {
  *room(8) = '\n';
  ++used_;
  row_begun_ = false;
}

void CsvWriter::flush() {
  if (used_ > 0) out_.write(buffer_.data(), static_cast<std::streamsize>(used_));
  used_ = 0;
}

}  // namespace spoolflow::recording
