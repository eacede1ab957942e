#pragma once
#include <string>
#include <vector>

#include "spoolflow/recording/files/sample_table.hpp"

namespace spoolflow::recording {

/// What a file is and what its columns are called, whether they are channels or not.
struct FileContents {
  std::string format;               ///< "CSV", "MATLAB", "HDF5", "TDMS"
  std::vector<FileColumn> columns;  ///< names, leaves, and the units as a units row or an attribute says
  std::vector<std::string> unread;  ///< what of its end is missing, what else it holds, and why that is not read

  [[nodiscard]] std::vector<std::string> names() const;
};
/// Of an open table. `format` as FileContents has it.
[[nodiscard]] FileContents contents_of(std::string format, const SampleTable& table);

}  // namespace spoolflow::recording
