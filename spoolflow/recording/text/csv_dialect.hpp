#pragma once
/// How a CSV file is written: found from its first lines.
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
  std::size_t least_cells = 0;               ///< of a row; those behind may be left out
  bool several_times = false;                ///< columns have an own_time
  std::string end_word{};                    ///< a line that is no row, behind the last one; empty: none
  std::string next_block{};                  ///< the beginning of a line with which other columns begin; empty: none
  std::optional<EvenStretch> stated_time{};  ///< of rows whose first cell is empty ...
  bool counts_samples = false;               ///< ... or counts them
};

/// Reads byte order mark, settings and lines of title, comments (lines that begin with #), "sep=;", header and units
/// row from the beginning of a file. Throws RecordingError: nothing in it, no header, no table, a binary file.
/// `runs_on`: of a source whose first rows may be damaged.
[[nodiscard]] CsvDialect read_csv_dialect(std::string_view beginning, const std::string& file, bool runs_on = false);

/// Whether the header is there as a whole, and one more line that distinguishes units from samples: all that
/// read_csv_dialect() needs of a stream whose rows are still to come.
[[nodiscard]] bool header_is_whole(std::string_view beginning);

}  // namespace spoolflow::recording
