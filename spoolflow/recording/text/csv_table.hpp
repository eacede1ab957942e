#pragma once
/// A CSV file as a table of numbers, read in large blocks; columns that were not chosen are stepped over unread. Of a
/// pipe each row is there as soon as its line is.
#include <memory>
#include <optional>

#include "spoolflow/recording/files/clock_time.hpp"
#include "spoolflow/recording/files/input_bytes.hpp"
#include "spoolflow/recording/files/sample_table.hpp"
#include "spoolflow/recording/text/csv_dialect.hpp"
#include "spoolflow/recording/text/decimal_sign.hpp"
#include "spoolflow/recording/text/utf16.hpp"
#include "spoolflow/units/unit.hpp"

namespace spoolflow::recording {

class CsvTable final : public SampleTable {
 public:
  /// What to do with a cell that is no number: refuse it; count it and take the sample as missing (to inspect); or
  /// likewise, and leave out lines that have not the header's number of cells, and the header itself where the next
  /// sender begins with it (of a source that runs on).
  enum class Text : std::uint8_t { refused, counted, left_out };

  /// Throws RecordingError where the header cannot be read. `beginning`: bytes already taken from `input`.
  CsvTable(std::unique_ptr<InputBytes> input, std::vector<char> beginning, Text text = Text::refused);

  [[nodiscard]] const std::vector<FileColumn>& columns() const override { return dialect_.columns; }
  void select(const std::vector<std::size_t>& columns) override;
  std::size_t read(std::span<double* const> out, std::size_t rows) override;
  [[nodiscard]] std::uint64_t left_out() const override { return left_out_; }
  [[nodiscard]] std::string place(std::size_t row) const override;
  [[nodiscard]] std::optional<double> progress() const override;

  [[nodiscard]] char delimiter() const { return dialect_.delimiter; }
  [[nodiscard]] char decimal_sign() const { return point_; }
  /// With Text::counted.
  [[nodiscard]] std::span<const TextCells> text_cells() const override { return text_cells_; }
  void let_infinite_pass() override { infinite_passes_ = true; }
  /// Whether columns state times of their own: then rows belong together by PairedTable alone.
  [[nodiscard]] bool has_several_times() const { return dialect_.several_times; }
  [[nodiscard]] std::uint64_t bytes_read() const { return input_->position(); }
  /// Before the first read().
  void count_text() { text_ = Text::counted; }

 private:
  void take_bytes();
  bool refill();
  void refuse_zero_bytes(std::size_t first) const;
  void end_last_line();
  void look_at_new_bytes();
  bool plain_row(const char*& cursor, std::span<double* const> out, std::size_t row) const;
  [[nodiscard]] bool header_again(std::string_view line) const;
  bool careful_row(std::string_view line, std::span<double* const> out, std::size_t row);
  /// Of a row whose first cell is empty, or counts it.
  double stated_time(std::string_view first_cell, std::size_t slot);
  /// A time of day that falls by more than half a day has passed midnight.
  double past_midnight(double time_s, std::size_t slot);
  double cell_value(std::string_view cell, std::size_t column, std::size_t slot);
  [[noreturn]] void refuse_length(std::size_t cells) const;
  [[noreturn]] void refuse_next_block() const;
  [[noreturn]] void refuse_grouping(const GroupedCell& cell) const;

  /// One chosen column: how many cells to step over from the end of the one before.
  struct Step {
    std::size_t skip;
    std::size_t slot;
  };

  std::unique_ptr<InputBytes> input_;
  Text text_;
  std::optional<ClockTime> clock_origin_;  ///< of the first sample; times of the clock count from it
  std::optional<Utf16> utf16_;             ///< of a file that is not in UTF-8 or an 8-bit encoding
  CsvDialect dialect_;
  char point_ = '.';
  bool point_known_ = false;
  DecimalSign sign_{{}};
  bool infinite_passes_ = false;
  bool quotes_ = false;  ///< a quote in the buffer: every row is read carefully
  std::vector<std::size_t> chosen_;
  std::vector<Step> steps_;
  std::vector<std::ptrdiff_t> slot_of_column_;
  std::vector<TextCells> text_cells_;
  std::vector<std::optional<units::Unit>> units_;  ///< of the chosen columns
  /// Of a column of times of day without a date.
  struct Midnights {
    double last_s = 0;
    int days = 0;
  };
  std::vector<Midnights> midnights_;
  std::uint64_t left_out_ = 0;
  std::uint64_t rows_ = 0;

  std::vector<char> buffer_;  ///< [cursor_, lines_end_) whole lines, [lines_end_, filled_) the beginning of the next
  std::size_t cursor_ = 0;
  std::size_t lines_end_ = 0;
  std::size_t filled_ = 0;
  bool at_end_ = false;
  std::uint64_t line_ = 0;                  ///< of the row before the cursor
  std::vector<std::uint64_t> line_of_row_;  ///< of the last read()
};

}  // namespace spoolflow::recording
