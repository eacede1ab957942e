#include "spoolflow/recording/csv_reader.hpp"

#include <cmath>
#include <cstring>
#include <limits>

#include <fmt/format.h>

#include "spoolflow/recording/byte_source.hpp"
#include "spoolflow/recording/column_binding.hpp"
#include "spoolflow/recording/csv_dialect.hpp"
#include "spoolflow/recording/decimal.hpp"
#include "spoolflow/recording/plausibility.hpp"
#include "spoolflow/recording/recording_error.hpp"
#include "spoolflow/recording/time_stamps.hpp"

namespace spoolflow::recording {
namespace {

constexpr std::size_t block_rows = 8192;
constexpr std::uint64_t fully_counted_rows =
    1000;  ///< rows whose every column is counted, to tell a wrong dialect early

class CsvReader final : public Reader {
 public:
  CsvReader(const std::filesystem::path& file, const ReadOptions& options)
      : file_(file == "-" ? "standard input" : file.string()), source_(file), plausibility_(file_), stamps_(file_) {
    read_header(options);
  }

  [[nodiscard]] const std::vector<FileColumn>& columns() const { return columns_; }
  [[nodiscard]] bool has(Channel channel) const override {
    for (const ColumnBinding& binding : bindings_) {
      if (binding.channel == channel) return true;
    }
    return false;
  }
  bool next(SampleBlock& block) override;
  [[nodiscard]] const ReadNotes& notes() const override { return notes_; }
  [[nodiscard]] std::optional<double> progress() const override { return source_.progress(); }

 private:
  void read_header(const ReadOptions& options);
  void take_row(std::string_view line, SampleBlock& block);
  double number_in(const char* begin, const char* end, const ColumnBinding& binding);
  [[noreturn]] void refuse_cell(std::string_view text, const ColumnBinding& binding) const;
  [[noreturn]] void refuse_row(std::size_t found) const;

  std::string file_;
  ByteSource source_;
  CsvDialect dialect_;
  std::vector<FileColumn> columns_;
  std::vector<ColumnBinding> bindings_;
  Plausibility plausibility_;
  TimeStamps stamps_;
  ReadNotes notes_;
  std::uint64_t line_ = 0;
  std::string pending_;  ///< the first data line, looked at for the decimal point
  bool has_pending_ = false;
  bool sizes_checked_ = false;
};

void CsvReader::read_header(const ReadOptions& options) {
  std::string_view line;
  if (!source_.next_line(line)) {
    throw RecordingError(
        fmt::format("{}: the file is empty; a recording has a header line and rows of numbers", file_));
  }
  ++line_;
  if (line.starts_with("\xef\xbb\xbf")) line.remove_prefix(3);
  if (std::memchr(line.data(), '\0', line.size()) != nullptr) {
    throw RecordingError(fmt::format("{}: holds binary data; readable are CSV, MATLAB v5 and v7.3, and HDF5", file_));
  }
  dialect_.delimiter = delimiter_of(line);
  const std::vector<std::string> names = split_fields(line, dialect_.delimiter);
  bool any_text = false;
  for (const std::string& name : names) {
    const Decimal number = read_decimal(name.data(), name.data() + name.size(), dialect_.delimiter == ',' ? '.' : ',');
    any_text = any_text || (!name.empty() && number.end == nullptr);
    columns_.push_back({name, ""});
  }
  if (!any_text) {
    throw RecordingError(fmt::format("{}, line 1: has no column names; put a line such as time_s{}current_A on top",
                                     file_, dialect_.delimiter));
  }
  while (source_.next_line(line)) {
    ++line_;
    if (line.empty()) continue;
    const std::vector<std::string> fields = split_fields(line, dialect_.delimiter);
    if (!has_pending_ && columns_[0].unit.empty() && is_units_row(fields)) {
      for (std::size_t k = 0; k < fields.size() && k < columns_.size(); ++k)
        columns_[k].unit = without_brackets(fields[k]);
      continue;
    }
    pending_ = line;
    has_pending_ = true;
    if (dialect_.delimiter != ',' && pending_.find(',') != std::string::npos) dialect_.decimal_point = ',';
    break;
  }
  bindings_ = bind_columns(columns_, options, file_);
  if (!has_pending_) {
    throw RecordingError(
        fmt::format("{}: has a header but no samples; record again, or check that the file is complete", file_));
  }
}

void CsvReader::refuse_cell(std::string_view text, const ColumnBinding& binding) const {
  std::string shown(text.substr(0, 40));
  std::string lower;
  for (const char c : shown) lower += static_cast<char>(c | 0x20);
  const bool not_finite = lower.find("nan") != std::string::npos || lower.find("inf") != std::string::npos;
  throw RecordingError(fmt::format("{}, line {}, column \"{}\": \"{}\" is {}; {}", file_, line_,
                                   columns_[binding.column].name, shown, not_finite ? "not finite" : "no number",
                                   not_finite ? "leave the cell empty where a sample is missing"
                                              : "cells hold decimal numbers, or nothing where a sample is missing"));
}

void CsvReader::refuse_row(std::size_t found) const {
  throw RecordingError(
      fmt::format("{}, line {}: has {} columns, the header has {}; {}", file_, line_, found, columns_.size(),
                  dialect_.delimiter == ',' ? "a decimal comma needs semicolons or tabs between the columns"
                                            : "the row was cut short or a delimiter is missing"));
}

double CsvReader::number_in(const char* begin, const char* end, const ColumnBinding& binding) {
  const Decimal number = read_decimal(begin, end, dialect_.decimal_point);
  if (number.end == end) return number.value;
  // The slow path: blanks, quotes, an empty cell, or no number.
  const std::vector<std::string> field = split_fields({begin, static_cast<std::size_t>(end - begin)}, '\0');
  const std::string& text = field.front();
  if (text.empty()) {
    ++notes_.missing_values;
    return std::numeric_limits<double>::quiet_NaN();
  }
  const Decimal again = read_decimal(text.data(), text.data() + text.size(), dialect_.decimal_point);
  if (again.end != text.data() + text.size()) refuse_cell(text, binding);
  return again.value;
}

void CsvReader::take_row(std::string_view line, SampleBlock& block) {
  const char* at = line.data();
  const char* const end = at + line.size();
  const char delimiter = dialect_.delimiter;
  std::size_t column = 0;
  for (const ColumnBinding& binding : bindings_) {
    while (column < binding.column) {
      const void* const found = std::memchr(at, delimiter, static_cast<std::size_t>(end - at));
      if (found == nullptr) refuse_row(column + 1);
      at = static_cast<const char*>(found) + 1;
      ++column;
    }
    const void* const found = std::memchr(at, delimiter, static_cast<std::size_t>(end - at));
    const char* const stop = found == nullptr ? end : static_cast<const char*>(found);
    const double raw = number_in(at, stop, binding);
    block.columns[static_cast<std::size_t>(binding.channel)].push_back(binding.scale * raw + binding.offset);
    at = stop;
  }
  if (notes_.rows < fully_counted_rows) {
    std::size_t found = column + 1;
    for (const char* c = at; c != end; ++c) found += *c == delimiter ? 1 : 0;
    if (found < columns_.size() ||
        (found > columns_.size() && !(found == columns_.size() + 1 && end[-1] == delimiter))) {
      refuse_row(found);
    }
  }
  ++notes_.rows;
  ++block.rows;
}

bool CsvReader::next(SampleBlock& block) {
  for (auto& column : block.columns) column.clear();
  block.rows = 0;
  if (has_pending_) {
    has_pending_ = false;
    take_row(pending_, block);
    stamps_.check(block, 0, line_, notes_);
  }
  std::string_view line;
  while (block.rows < block_rows && source_.next_line(line)) {
    ++line_;
    if (line.empty()) continue;
    take_row(line, block);
    stamps_.check(block, block.rows - 1, line_, notes_);
  }
  if (block.rows > 0) plausibility_.take(block);
  if (!sizes_checked_ && (block.rows == block_rows || block.rows == 0)) {
    plausibility_.check_sizes();
    sizes_checked_ = true;
  }
  return block.rows > 0;
}

}  // namespace

std::unique_ptr<Reader> open_csv(const std::filesystem::path& file, const ReadOptions& options) {
  return std::make_unique<CsvReader>(file, options);
}

std::vector<FileColumn> columns_of_csv(const std::filesystem::path& file) {
  ReadOptions nothing;
  nothing.optional = {Channel::test};  // any single channel: the columns are listed, not bound
  nothing.channels.sources.clear();
  return CsvReader(file, nothing).columns();
}

}  // namespace spoolflow::recording
