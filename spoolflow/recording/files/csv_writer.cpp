#include "spoolflow/recording/files/csv_writer.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <ostream>

#include <fmt/format.h>

namespace spoolflow::recording {
namespace {

constexpr std::size_t buffer_size = std::size_t{1} << 16;
constexpr std::array<double, 10> power{1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9};

/// Two decimal digits at a time.
constexpr auto digit_pairs = [] {
  std::array<char, 200> pairs{};
  for (std::size_t k = 0; k < 100; ++k) {
    pairs[2 * k] = static_cast<char>('0' + k / 10);
    pairs[2 * k + 1] = static_cast<char>('0' + k % 10);
  }
  return pairs;
}();

/// The digits of `value` ending at `end`, at least `least` of them; returns where they begin.
char* write_backwards(char* end, std::uint64_t value, int least) {
  char* at = end;
  while (value >= 100) {
    at -= 2;
    std::memcpy(at, digit_pairs.data() + 2 * (value % 100), 2);
    value /= 100;
  }
  if (value >= 10) {
    at -= 2;
    std::memcpy(at, digit_pairs.data() + 2 * value, 2);
  } else {
    *--at = static_cast<char>('0' + value);
  }
  while (end - at < least) *--at = '0';
  return at;
}

}  // namespace

CsvWriter::CsvWriter(std::ostream& out) : out_(out), buffer_(buffer_size) {}

CsvWriter::~CsvWriter() {
  try {
    flush();
  } catch (...) {  // the stream keeps its error; whoever commits the file meets it
  }
}

void CsvWriter::room(std::size_t bytes) {
  if (buffer_.size() - used_ < bytes) flush();
}

void CsvWriter::separate() {
  if (row_begun_) buffer_[used_++] = ',';
  row_begun_ = true;
}

void CsvWriter::header(const std::vector<std::string>& names) {
  for (const std::string& name : names) text(name);
  end_row();
}

void CsvWriter::number(double value, int decimals) {
  room(512);
  separate();
  if (std::isnan(value)) return;
  const double scaled = std::abs(value) * power[static_cast<std::size_t>(decimals)];
  if (!(scaled < 9e15)) {
    const auto written = fmt::format_to_n(buffer_.data() + used_, 400, "{:.{}f}", value, decimals);
    used_ += static_cast<std::size_t>(written.out - (buffer_.data() + used_));
    return;
  }
  const auto digits = static_cast<std::uint64_t>(std::floor(scaled + 0.5));
  std::array<char, 32> text;
  char* const end = text.data() + text.size();
  char* begin = write_backwards(end, digits, decimals + 1);
  if (value < 0 && digits != 0) buffer_[used_++] = '-';
  const std::size_t whole = static_cast<std::size_t>(end - begin) - static_cast<std::size_t>(decimals);
  std::memcpy(buffer_.data() + used_, begin, whole);
  used_ += whole;
  if (decimals > 0) {
    buffer_[used_++] = '.';
    std::memcpy(buffer_.data() + used_, begin + whole, static_cast<std::size_t>(decimals));
    used_ += static_cast<std::size_t>(decimals);
  }
}

void CsvWriter::text(std::string_view text) {
  room(2 * text.size() + 8);
  if (buffer_.size() < 2 * text.size() + 8) buffer_.resize(2 * text.size() + 8);
  separate();
  const bool quoted = text.find_first_of(",\"\n\r") != std::string_view::npos;
  if (quoted) buffer_[used_++] = '"';
  for (const char c : text) {
    if (c == '"') buffer_[used_++] = '"';
    buffer_[used_++] = c;
  }
  if (quoted) buffer_[used_++] = '"';
}

void CsvWriter::end_row() {
  room(8);
  buffer_[used_++] = '\n';
  row_begun_ = false;
}

void CsvWriter::flush() {
  if (used_ > 0) out_.write(buffer_.data(), static_cast<std::streamsize>(used_));
  used_ = 0;
}

}  // namespace spoolflow::recording
