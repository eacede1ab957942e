#include "spoolflow/recording/text/csv_table.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

#include <fmt/format.h>

#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/recording/files/decimal_number.hpp"
#include "spoolflow/recording/text/cell_unit.hpp"
#include "spoolflow/recording/text/csv_cells.hpp"
#include "spoolflow/recording/text/csv_scan.hpp"
#include "spoolflow/recording/text/grouped_number.hpp"

namespace spoolflow::recording {
namespace {

constexpr std::size_t block_bytes = std::size_t{256} << 10;
constexpr std::size_t longest_line = std::size_t{4} << 20;
constexpr double missing = std::numeric_limits<double>::quiet_NaN();
constexpr std::string_view infinity_sign = "\xE2\x88\x9E";
constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

CsvTable::CsvTable(std::unique_ptr<InputBytes> input, std::vector<char> beginning, Text text)
    : input_(std::move(input)), text_(text), utf16_(Utf16::of({beginning.data(), beginning.size()})) {
  buffer_ = std::move(beginning);
  if (utf16_) {
    const std::string decoded = utf16_->decoded({buffer_.data(), buffer_.size()});
    buffer_.assign(decoded.begin(), decoded.end());
  }
  filled_ = buffer_.size();
  buffer_.resize(std::max(filled_, block_bytes) + scan_padding);
  const auto enough = [this] {
    return filled_ >= block_bytes || (input_->comes_bit_by_bit() && header_is_whole({buffer_.data(), filled_}));
  };
  while (!at_end_ && !enough()) take_bytes();
  end_last_line();
  refuse_zero_bytes(0);
  dialect_ = read_csv_dialect({buffer_.data(), filled_}, input_->name(), text_ == Text::left_out);
  if (!at_end_ && filled_ >= block_bytes && dialect_.header_bytes == filled_) {
    throw RecordingError(fmt::format("{}: its header goes on for more than {} KiB; this is no CSV recording",
                                     input_->name(), block_bytes >> 10));
  }
  cursor_ = dialect_.header_bytes;
  line_ = dialect_.header_lines;
  look_at_new_bytes();
}

/// Behind those that are there; of a pipe no more than have come.
void CsvTable::take_bytes() {
  const bool by_bits = input_->comes_bit_by_bit();
  const std::size_t room = buffer_.size() - scan_padding - filled_;
  std::vector<char> raw(utf16_ ? room : 0);
  char* const out = utf16_ ? raw.data() : buffer_.data() + filled_;
  const std::size_t got = by_bits ? input_->read_some(out, room) : input_->read(out, room);
  at_end_ = by_bits ? got == 0 : got < room;
  if (!utf16_) {
    filled_ += got;
    return;
  }
  const std::string decoded = utf16_->decoded({raw.data(), got});
  buffer_.resize(std::max(buffer_.size(), filled_ + decoded.size() + scan_padding));  // two bytes become three at most
  std::ranges::copy(decoded, buffer_.begin() + static_cast<std::ptrdiff_t>(filled_));
  filled_ += decoded.size();
}

void CsvTable::select(const std::vector<std::size_t>& columns) {
  chosen_ = columns;
  text_cells_.assign(columns.size(), {});
  units_.clear();
  for (const std::size_t column : columns) units_.push_back(unit_of(dialect_.columns[column]));
  midnights_.assign(columns.size(), {});
  sign_ = DecimalSign(columns);
  slot_of_column_.assign(dialect_.columns.size(), -1);
  for (std::size_t slot = 0; slot < columns.size(); ++slot) {
    slot_of_column_[columns[slot]] = static_cast<std::ptrdiff_t>(slot);
  }
  std::size_t next = 0;
  for (std::size_t column = 0; column < slot_of_column_.size(); ++column) {
    if (slot_of_column_[column] < 0) continue;
    steps_.push_back({column - next, static_cast<std::size_t>(slot_of_column_[column])});
    next = column + 1;
  }
  look_at_new_bytes();
}

/// Text holds none; looked for from `first` of the buffer on.
void CsvTable::refuse_zero_bytes(std::size_t first) const {
  if (text_ == Text::left_out) return;
  const void* const zero = std::memchr(buffer_.data() + first, '\0', filled_ - first);
  if (zero == nullptr) return;
  const auto before = static_cast<std::size_t>(static_cast<const char*>(zero) - buffer_.data());
  throw RecordingError(fmt::format(
      "{}: is not text: it holds a zero byte at byte {}; it is damaged, or save the recording as CSV, MAT or "
      "HDF5",
      input_->name(), input_->position() - filled_ + before + 1));
}

void CsvTable::end_last_line() {
  if (!at_end_ || filled_ == cursor_ || buffer_[filled_ - 1] == '\n') return;
  buffer_.resize(std::max(buffer_.size(), filled_ + 1 + scan_padding));
  buffer_[filled_++] = '\n';
}

/// Whole lines now end at lines_end_; returns what they need.
void CsvTable::look_at_new_bytes() {
  end_last_line();
  const std::string_view fresh(buffer_.data() + cursor_, filled_ - cursor_);
  const std::size_t last = fresh.rfind('\n');
  lines_end_ = last == std::string_view::npos ? cursor_ : cursor_ + last + 1;
  const std::string_view lines = fresh.substr(0, lines_end_ - cursor_);
  quotes_ = lines.find('"') != std::string_view::npos;
  if (point_known_ || chosen_.empty()) return;
  sign_.look_at(lines, dialect_.delimiter);
  const std::optional<char> sign = sign_.found();
  if (!sign) return;
  point_ = *sign;
  point_known_ = true;
  if (const std::optional<GroupedCell> cell = sign_.grouped()) refuse_grouping(*cell);
}

void CsvTable::refuse_grouping(const GroupedCell& cell) const {
  const std::string name = dialect_.columns[cell.column].name;
  throw RecordingError(
      fmt::format("{}, column '{}': '{}' stands beside whole numbers without '{}', so '{}' seems to group thousands, "
                  "and its numbers "
                  "cannot be distinguished from decimals; write numbers without marks for thousands, such as 1088",
                  input_->name(), name, shortened(cell.text), point_, point_));
}

bool CsvTable::refill() {
  while (cursor_ == lines_end_) {
    if (at_end_) return false;
    const std::size_t begun = filled_ - cursor_;
    if (begun > longest_line) {
      throw RecordingError(fmt::format("{}, line {}: goes on for more than {} MiB; this is no CSV recording",
                                       input_->name(), line_ + 1, longest_line >> 20));
    }
    std::memmove(buffer_.data(), buffer_.data() + cursor_, begun);
    buffer_.resize(begun + block_bytes + scan_padding);
    cursor_ = 0;
    filled_ = begun;
    take_bytes();
    refuse_zero_bytes(begun);
    look_at_new_bytes();
  }
  return true;
}

/// The fast path: bare numbers, no quotes, the right number of cells; anything else is false and nothing has moved.
bool CsvTable::plain_row(const char*& cursor, std::span<double* const> out, std::size_t row) const {
  CellEnds ends(cursor, dialect_.delimiter);
  const char* text = cursor;
  std::size_t left = dialect_.columns.size();
  const auto step_over = [&](std::size_t cells) {
    for (; cells > 0; --cells) {
      const char* const cell_end = ends.next();
      if (*cell_end == '\n') return false;
      text = cell_end + 1;
    }
    return true;
  };
  for (const Step& step : steps_) {
    if (!step_over(step.skip)) return false;
    left -= step.skip + 1;
    const char* const cell_end = ends.next();
    const bool line_ends = *cell_end == '\n';
    const bool returns = line_ends && cell_end != text && cell_end[-1] == '\r';
    if (line_ends != (left == 0)) return false;
    if (!read_decimal(text, cell_end - static_cast<int>(returns), point_, out[step.slot][row])) return false;
    text = cell_end + 1;
  }
  if (left > 0) {
    if (!step_over(left - 1)) return false;
    const char* const line_end = ends.next();
    if (*line_end != '\n') return false;
    text = line_end + 1;
  }
  cursor = text;
  return true;
}

double CsvTable::cell_value(std::string_view cell, std::size_t column, std::size_t slot) {
  double value = 0.0;
  const Digits digits = read_number(cell, point_, value);
  if (digits == Digits::number) return value;
  if (digits == Digits::empty) return missing;
  if (const std::optional<ClockTime> clock = read_clock_time(cell)) {
    if (!clock_origin_) clock_origin_ = clock;
    return clock->day == 0 ? past_midnight(clock->since(*clock_origin_), slot) : clock->since(*clock_origin_);
  }
  if (const auto plain = without_groups(cell); plain && plain->may_be_of(point_)) return plain->value;
  if (infinite_passes_ && (digits == Digits::not_finite || cell.find(infinity_sign) != std::string_view::npos)) {
    return cell.find('-') == std::string_view::npos ? infinity : -infinity;
  }
  const Suffix suffix = read_measured(cell, point_, units_[slot], value);
  if (suffix == Suffix::understood) return value;
  if (text_ != Text::refused) {
    if (++text_cells_[slot].count == 1)
      text_cells_[slot].first = fmt::format("'{}' in line {}", shortened(cell), line_);
    return missing;
  }
  const std::string place =
      fmt::format("{}, line {}, column '{}'", input_->name(), line_, dialect_.columns[column].name);
  const std::string shown = shortened(cell);
  if (cell.find(infinity_sign) != std::string_view::npos) {
    throw RecordingError(fmt::format(
        "{}: '{}' is what PicoScope writes where a channel is saturated; widen its range and record it again, or leave "
        "the cell empty",
        place, shown));
  }
  if (digits == Digits::not_finite) {
    throw RecordingError(
        fmt::format("{}: '{}' is not finite; leave the cell empty where a sample is missing", place, shown));
  }
  if (digits == Digits::out_of_range) {
    throw RecordingError(fmt::format("{}: '{}' is larger than any number that can be kept (1.8e308)", place, shown));
  }
  if (suffix != Suffix::none)
    throw RecordingError(fmt::format("{}: {}", place, suffix_fault(suffix, shown, units_[slot])));
  throw RecordingError(
      fmt::format("{}: '{}' is not a number (decimal sign here: '{}'); correct it, or leave the cell "
                  "empty where a sample is missing",
                  place, shown, point_));
}

double CsvTable::stated_time(std::string_view first_cell, std::size_t slot) {
  const double sample = first_cell.empty() ? static_cast<double>(rows_) : cell_value(first_cell, 0, slot);
  return dialect_.stated_time->begin_s + sample * dialect_.stated_time->step_s;
}

double CsvTable::past_midnight(double time_s, std::size_t slot) {
  constexpr double day_s = 86400;
  Midnights& passed = midnights_[slot];
  if (time_s + passed.days * day_s < passed.last_s - 0.5 * day_s) ++passed.days;
  passed.last_s = time_s + passed.days * day_s;
  return passed.last_s;
}

void CsvTable::refuse_length(std::size_t cells) const {
  throw RecordingError(
      fmt::format("{}, line {}: has {} cells, the header has {} (delimiter '{}'); complete the line or "
                  "remove it",
                  input_->name(), line_, cells, dialect_.columns.size(),
                  dialect_.delimiter == '\t' ? std::string("tab") : std::string(1, dialect_.delimiter)));
}

void CsvTable::refuse_next_block() const {
  throw RecordingError(fmt::format(
      "{}, line {}: another block of samples begins, with settings of its own; save each block as a file of "
      "its own, or cut this one before that line",
      input_->name(), line_));
}

/// Whether the line is the header, which the next sender into the same pipe begins with. Throws RecordingError where
/// it is another header: what follows would be read as the wrong channels.
bool CsvTable::header_again(std::string_view line) const {
  std::size_t same = 0;
  std::size_t elsewhere = 0;
  bool last = false;
  for (std::size_t column = 0; !last; ++column) {
    const CsvCell cell = take_cell(line, dialect_.delimiter);
    last = cell.last;
    double number = 0.0;
    if (cell.text.empty() || read_number(cell.text, point_, number) == Digits::number) return false;
    const auto named = std::ranges::find(dialect_.columns, cell.text, &FileColumn::leaf);
    if (named == dialect_.columns.end()) continue;
    ++(named - dialect_.columns.begin() == static_cast<std::ptrdiff_t>(column) ? same : elsewhere);
  }
  if (elsewhere > 0) {
    throw RecordingError(
        fmt::format("{}, line {}: a header with its columns in another order than before; close the "
                    "connection before the channels change",
                    input_->name(), line_));
  }
  return same == dialect_.columns.size();
}

/// Any row: quotes, spaces, exponents, empty cells, trailing delimiters; and every refusal. False where it is left out.
bool CsvTable::careful_row(std::string_view line, std::span<double* const> out, std::size_t row) {
  if (text_ == Text::left_out && header_again(line)) return false;
  std::size_t cells = 0;
  std::size_t used = 0;  // up to the last cell that is not empty
  for (bool last = false; !last; ++cells) {
    const CsvCell cell = take_cell(line, dialect_.delimiter);
    last = cell.last;
    if (!cell.text.empty()) used = cells + 1;
    if (cells >= slot_of_column_.size() || slot_of_column_[cells] < 0) continue;
    const auto slot = static_cast<std::size_t>(slot_of_column_[cells]);
    const bool stated = dialect_.stated_time && cells == 0 && (cell.text.empty() || dialect_.counts_samples);
    out[slot][row] = stated ? stated_time(cell.text, slot) : cell_value(cell.text, cells, slot);
  }
  if (dialect_.least_cells > 0 && cells >= dialect_.least_cells) {
    for (; cells < slot_of_column_.size(); ++cells)
      if (slot_of_column_[cells] >= 0) out[static_cast<std::size_t>(slot_of_column_[cells])][row] = missing;
  }
  if (cells < dialect_.columns.size() || used > dialect_.columns.size()) {
    if (text_ != Text::left_out) refuse_length(cells);
    ++left_out_;
    return false;
  }
  return true;
}

std::size_t CsvTable::read(std::span<double* const> out, std::size_t rows) {
  line_of_row_.resize(rows);
  std::size_t row = 0;
  const bool waits = !input_->comes_bit_by_bit();  // for more, while rows are there to be handed out
  while (row < rows && (waits || row == 0 || cursor_ != lines_end_) && refill()) {
    const char* cursor = buffer_.data() + cursor_;
    const char* const end = buffer_.data() + lines_end_;
    while (row < rows && cursor != end) {
      ++line_;
      if (quotes_ || dialect_.counts_samples || *cursor == '#' || !plain_row(cursor, out, row)) {
        std::string_view rest(cursor, static_cast<std::size_t>(end - cursor));
        const std::string_view line = take_line(rest);
        cursor = rest.empty() ? end : rest.data();
        if (line.starts_with('#') || line.find_first_not_of(" \t") == std::string_view::npos) continue;
        if (!dialect_.end_word.empty() && without_blanks(line) == dialect_.end_word) continue;
        if (!dialect_.next_block.empty() && line.starts_with(dialect_.next_block)) refuse_next_block();
        if (!careful_row(line, out, row)) continue;
      }
      line_of_row_[row++] = line_;
      ++rows_;
    }
    cursor_ = static_cast<std::size_t>(cursor - buffer_.data());
  }
  line_of_row_.resize(row);
  return row;
}

std::string CsvTable::place(std::size_t row) const {
  return fmt::format("{}, line {}", input_->name(), row < line_of_row_.size() ? line_of_row_[row] : line_);
}

std::optional<double> CsvTable::progress() const {
  const auto size = input_->size();
  if (!size || *size == 0) return std::nullopt;
  const std::uint64_t used = input_->position() - std::min<std::uint64_t>(input_->position(), filled_ - cursor_);
  return std::min(1.0, static_cast<double>(used) / static_cast<double>(*size));
}

}  // namespace spoolflow::recording
