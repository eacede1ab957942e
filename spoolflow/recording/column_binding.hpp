#pragma once
/// Which column of a file becomes which channel, and how its raw values become SI.
#include <cstddef>
#include <string>
#include <vector>

#include "spoolflow/recording/reader.hpp"

namespace spoolflow::recording {

/// A column as a file names it; `unit` is what a units row or an attribute says, else empty.
struct FileColumn {
  std::string name;
  std::string unit;
};

/// value_SI = scale * raw + offset.
struct ColumnBinding {
  Channel channel;
  std::size_t column;
  double scale;
  double offset;
  std::string unit;  ///< as written, for messages
};

/// A header of the form <channel>_<unit>, such as "oil_temperature_C"; `test` has no unit. False where it is none.
[[nodiscard]] bool parse_header(const std::string& header, Channel& channel, std::string& unit);

/// Binds the asked-for channels, in the order of the columns. Throws RecordingError: a required channel or a mapped
/// column that the file lacks (with what it has), two columns for one channel, an unknown unit or one of another
/// quantity.
[[nodiscard]] std::vector<ColumnBinding> bind_columns(const std::vector<FileColumn>& columns,
                                                      const ReadOptions& options, const std::string& file);

}  // namespace spoolflow::recording
