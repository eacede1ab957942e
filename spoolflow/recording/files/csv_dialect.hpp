#pragma once
/// How a CSV file is written: told from its first lines.
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "spoolflow/recording/files/sample_table.hpp"

namespace spoolflow::recording {

struct CsvDialect {
  char delimiter = ',';  ///< comma, semicolon or tab
  std::vector<FileColumn> columns;
  std::size_t header_bytes = 0;  ///< up to the first row of samples
  std::uint64_t header_lines = 0;
};

/// Reads byte order mark, lines of title, comments (lines that begin with #), "sep=;", header and units row from the
/// beginning of a file. Throws RecordingError: nothing in it, no header, a binary file.
[[nodiscard]] CsvDialect read_csv_dialect(std::string_view beginning, const std::string& file);

/// Whether the header is there as a whole, and one more line that tells units from samples: all that read_csv_dialect()
/// needs of a stream whose rows are still to come.
[[nodiscard]] bool header_is_whole(std::string_view beginning);

/// A cell that looks as if its mark groups thousands.
struct GroupedCell {
  std::size_t column;
  std::string text;
};

/// The decimal sign of a file, comma or point, from the cells of its first lines.
class DecimalSign {
 public:
  explicit DecimalSign(const std::vector<std::size_t>& wanted) {
    for (const std::size_t column : wanted) columns_[column];
  }
  /// Whole lines that come after those looked at before.
  void look_at(std::string_view lines, char delimiter);
  /// Nothing where all numbers so far are whole.
  [[nodiscard]] std::optional<char> found() const;
  /// The first cell of a column in which that sign only ever stands before groups of three digits, beside whole numbers
  /// of up to three digits: 951 and 1,088. Whether that is 1088 or 1.088 cannot be known.
  [[nodiscard]] std::optional<GroupedCell> grouped() const;

 private:
  static constexpr std::size_t enough = 64;
  /// What a column's cells say of one mark.
  struct Cells {
    std::size_t whole = 0, grouped = 0, decimal = 0;
    std::string first{};  ///< of the grouped ones
  };
  std::array<std::size_t, 2> marked_{};  ///< cells with a point, with a comma
  std::map<std::size_t, std::array<Cells, 2>> columns_{};
};

/// Takes the next cell off a line (quotes removed from cells that begin and end with one); `line` is empty after the
/// last cell, and `last` tells it from an empty cell that follows.
struct CsvCell {
  std::string_view text;
  bool last;
};
[[nodiscard]] CsvCell take_cell(std::string_view& line, char delimiter);

/// Takes the next line off, without its line end.
[[nodiscard]] std::string_view take_line(std::string_view& text);

}  // namespace spoolflow::recording
