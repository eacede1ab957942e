#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "spoolflow/numerics/little_endian.hpp"
#include "spoolflow/recording/written_tables/table_writers.hpp"

namespace spoolflow::recording {
namespace {

using Bytes = std::vector<std::uint8_t>;
using numerics::put_little_endian;

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

constexpr std::size_t rows_of_a_strip = 65536;
constexpr std::uint64_t most_rows = (std::uint64_t{1} << 28U) - 16;  // a variable has less than 2^31 bytes

// Variables of MATLAB files of version 5 ("MAT-File Level 5 Format"): a tag, flags, sizes, a name, the numbers.

enum class MatClass : std::uint8_t { structure = 2, text = 4, number = 6, word = 13 };

// Types of elements.
constexpr std::uint32_t int8 = 1, int32 = 5, uint32 = 6, float64 = 9, matrix = 14, utf8 = 16;

void put_tag(Bytes& out, std::uint32_t type, std::uint64_t bytes) {
  put_little_endian(out, type);
  put_little_endian(out, static_cast<std::uint32_t>(bytes));
}

void pad(Bytes& out) {
  while (out.size() % 8 != 0) out.push_back(0);
}

/// Kind, sizes and name.
Bytes description(const std::string& name, MatClass kind, std::uint64_t rows, std::uint64_t columns) {
  Bytes out;
  put_tag(out, uint32, 8);
  put_little_endian(out, static_cast<std::uint64_t>(kind));
  put_tag(out, int32, 8);
  put_little_endian(out, static_cast<std::uint32_t>(rows));
  put_little_endian(out, static_cast<std::uint32_t>(columns));
  put_tag(out, int8, name.size());
  out.insert(out.end(), name.begin(), name.end());
  pad(out);
  return out;
}

Bytes whole(const Bytes& content) {
  Bytes out;
  put_tag(out, matrix, content.size());
  out.insert(out.end(), content.begin(), content.end());
  return out;
}

/// All of a column vector's variable that stands before its numbers, which follow with padding to 8 bytes.
Bytes mat_vector_head(const std::string& name, MatClass kind, std::uint64_t rows) {
  const std::uint64_t bytes = rows * (kind == MatClass::word ? 4 : 8);
  const Bytes about = description(name, kind, rows, 1);
  Bytes out;
  put_tag(out, matrix, about.size() + 8 + (bytes + 7) / 8 * 8);
  out.insert(out.end(), about.begin(), about.end());
  put_tag(out, kind == MatClass::word ? uint32 : float64, bytes);
  return out;
}

/// A whole variable, or a field without a name: a matrix of letters, a line a row, filled up with blanks. ASCII.
Bytes mat_text(const std::string& name, const std::vector<std::string>& lines) {
  std::size_t letters = 0;
  for (const std::string& line : lines) letters = std::max(letters, line.size());
  Bytes out = description(name, MatClass::text, lines.size(), letters);
  put_tag(out, utf8, lines.size() * letters);
  for (std::size_t column = 0; column < letters; ++column) {
    for (const std::string& line : lines)
      out.push_back(static_cast<std::uint8_t>(column < line.size() ? line[column] : ' '));
  }
  pad(out);
  return whole(out);
}

/// `fields`: names of at most 31 letters, each with a variable without a name.
Bytes mat_structure(const std::string& name, const std::vector<std::pair<std::string, Bytes>>& fields) {
  constexpr std::uint32_t name_bytes = 32;
  Bytes out = description(name, MatClass::structure, 1, 1);
  put_little_endian(out, std::uint32_t{4} << 16U | int32);  // a short element: its size and type in one word
  put_little_endian(out, name_bytes);
  put_tag(out, int8, fields.size() * name_bytes);
  for (const auto& [field, content] : fields) {
    out.insert(out.end(), field.begin(), field.end());
    out.resize(out.size() + name_bytes - field.size());
  }
  for (const auto& [field, content] : fields) out.insert(out.end(), content.begin(), content.end());
  return whole(out);
}

/// The scratch file holds strips of rows; of each strip one column after the other, 8 bytes a number.
class MatWriter final : public TableWriter {
 public:
  MatWriter(TableHead head, TableOutput& output)
      : head_(std::move(head)),
        out_(output.in_sequence()),
        scratch_(output.scratch()),
        strip_((head_.numbers.size() + 1) * 8 * rows_of_a_strip) {}

  void write(const TableRows& rows) override {
    if (rows_ + rows.count() > most_rows)
      throw std::length_error(
          "a MATLAB file of version 5 holds at most 268435440 rows; write .h5 or .parquet, which hold any number");
    for (std::size_t from = 0; from < rows.count();) {
      const std::size_t gathered = rows_ % rows_of_a_strip;
      const std::size_t count = std::min(rows.count() - from, rows_of_a_strip - gathered);
      for (std::size_t k = 0; k < head_.numbers.size(); ++k)
        put_numbers(column(k) + 8 * gathered, rows.numbers[k].data() + from, count);
      put_words(column(head_.numbers.size()) + 4 * gathered, rows.flags.data() + from, count);
      from += count, rows_ += count;
      if (rows_ % rows_of_a_strip == 0) scratch_.write((rows_ / rows_of_a_strip - 1) * strip_.size(), strip_);
    }
  }

  void finish() override {
    if (rows_ % rows_of_a_strip != 0) scratch_.write(rows_ / rows_of_a_strip * strip_.size(), strip_);
    put(file_head());
    for (std::size_t k = 0; k < head_.numbers.size(); ++k) {
      put(mat_vector_head(head_.numbers[k].name, MatClass::number, rows_));
      put_column(k, 8);
    }
    put(mat_vector_head(head_.flags, MatClass::word, rows_));
    put_column(head_.numbers.size(), 4);
    put(Bytes(rows_ % 2 * 4));
    std::vector<std::pair<std::string, Bytes>> units;
    for (const NumberColumn& column : head_.numbers) units.emplace_back(column.name, mat_text("", {column.unit}));
    put(mat_structure(head_.name + "_units", units));
    std::vector<std::string> names;
    for (const FlagName& flag : head_.flag_names) {
      names.resize(std::max<std::size_t>(names.size(), std::bit_width(flag.bit)));
      names[std::bit_width(flag.bit) - 1] = flag.name;
    }
    put(mat_text(head_.flags + "_names", names));
  }

 private:
  std::uint8_t* column(std::size_t k) { return strip_.data() + k * 8 * rows_of_a_strip; }

  static void put_numbers(std::uint8_t* to, const double* values, std::size_t count) {
    std::memcpy(to, values, 8 * count);
  }
  static void put_words(std::uint8_t* to, const std::uint32_t* words, std::size_t count) {
    std::memcpy(to, words, 4 * count);
  }

  void put(const Bytes& bytes) {
    out_.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  }

  void put_column(std::size_t k, std::size_t number_bytes) {
    Bytes part(number_bytes * rows_of_a_strip);
    for (std::uint64_t row = 0; row < rows_; row += rows_of_a_strip) {
      part.resize(number_bytes * std::min<std::uint64_t>(rows_of_a_strip, rows_ - row));
      scratch_.read(row / rows_of_a_strip * strip_.size() + k * 8 * rows_of_a_strip, part);
      put(part);
    }
  }

  /// 128 bytes: text that begins as MATLAB's, the version, the byte order.
  [[nodiscard]] Bytes file_head() const {
    std::string text = "MATLAB 5.0 MAT-file";
    for (const auto& [key, value] : head_.notes) text += ", " + key + ": " + value;
    for (char& c : text) c = static_cast<unsigned char>(c) < 128 && c >= ' ' ? c : '?';
    constexpr std::size_t text_bytes = 116, version_at = 124;
    text.resize(text_bytes, ' ');
    text.resize(version_at, '\0');
    Bytes out(text.begin(), text.end());
    put_little_endian(out, std::uint16_t{0x0100});
    put_little_endian(out, std::uint16_t{0x4D49});
    return out;
  }

  TableHead head_;
  std::ostream& out_;
  PlacedBytes& scratch_;
  Bytes strip_;
  std::uint64_t rows_ = 0;
};

}  // namespace

std::unique_ptr<TableWriter> mat_writer(TableHead head, TableOutput& output) {
  return std::make_unique<MatWriter>(std::move(head), output);
}

}  // namespace spoolflow::recording
