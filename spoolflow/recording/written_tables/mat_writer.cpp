#include <algorithm>
#include <bit>
#include <cstring>
#include <stdexcept>

#include "spoolflow/numerics/little_endian.hpp"
#include "spoolflow/recording/written_tables/mat_variable.hpp"
#include "spoolflow/recording/written_tables/table_writers.hpp"

namespace spoolflow::recording {
namespace {

using Bytes = std::vector<std::uint8_t>;

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

constexpr std::size_t rows_of_a_strip = 65536;
constexpr std::uint64_t most_rows = (std::uint64_t{1} << 28U) - 16;  // a variable has less than 2^31 bytes

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
    numerics::put_little_endian(out, std::uint16_t{0x0100});
    numerics::put_little_endian(out, std::uint16_t{0x4D49});
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
