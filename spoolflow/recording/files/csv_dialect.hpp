#pragma once
/// How a CSV file is written: told from its first lines.
#include <cstdint>
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

/// The decimal sign, comma or point, of the numbers in these whole lines; nothing where all are integers.
/// `wanted`: the columns to look at.
[[nodiscard]] std::optional<char> decimal_sign(std::string_view lines, char delimiter,
                                               const std::vector<std::size_t>& wanted);

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
