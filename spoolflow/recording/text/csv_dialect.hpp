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
  char delimiter = ',';  ///< comma, semicolon, tab or blank
  std::vector<FileColumn> columns;
  std::size_t header_bytes = 0;  ///< up to the first row of samples
  std::uint64_t header_lines = 0;
  bool last_may_lack = false;                ///< the last column, of remarks, may be left out of a row
  std::optional<EvenStretch> stated_time{};  ///< of rows whose first cell is empty
};

/// Reads byte order mark, settings and lines of title, comments (lines that begin with #), "sep=;", header and units
/// row from the beginning of a file. Throws RecordingError: nothing in it, no header, a binary file.
[[nodiscard]] CsvDialect read_csv_dialect(std::string_view beginning, const std::string& file);

/// Whether the header is there as a whole, and one more line that tells units from samples: all that read_csv_dialect()
/// needs of a stream whose rows are still to come.
[[nodiscard]] bool header_is_whole(std::string_view beginning);

}  // namespace spoolflow::recording
