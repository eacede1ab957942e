#pragma once
/// What a file is and what its columns are called.
#include <cstddef>
#include <string>
#include <vector>

#include "spoolflow/recording/files/sample_table.hpp"

namespace spoolflow::recording {

/// What a file is and what its columns are called, whether they are channels or not.
struct FileContents {
  std::string format;  ///< "CSV", "MATLAB", "HDF5", "TDMS"
  std::vector<std::string> columns;
  /// What each column's name is looked for in: the last part of its name, or what the file labels it with.
  std::vector<std::string> leaves;
  std::vector<std::string> units;   ///< as a units row or an attribute says; empty where nothing does
  std::vector<std::string> unread;  ///< what of its end is missing, what else it holds, and why that is not read

  /// As a reader finds it.
  [[nodiscard]] FileColumn column(std::size_t index) const { return {columns[index], leaves[index], units[index], {}}; }
};
/// Of an open table. `format` as FileContents has it.
[[nodiscard]] FileContents contents_of(std::string format, const SampleTable& table);

}  // namespace spoolflow::recording
