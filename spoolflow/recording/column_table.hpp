#pragma once
/// Columns of a file that is read whole (MATLAB, HDF5), served as a stream of blocks.
#include <memory>
#include <string>
#include <vector>

#include "spoolflow/recording/column_binding.hpp"
#include "spoolflow/recording/reader.hpp"

namespace spoolflow::recording {

struct BoundColumn {
  ColumnBinding binding;
  std::string name;
  std::vector<double> raw;  ///< as in the file
};

/// Converts to SI and checks: equal lengths, finite values, time that goes on, plausible sizes. Throws RecordingError.
[[nodiscard]] std::unique_ptr<Reader> serve_columns(std::vector<BoundColumn> columns, const std::string& file);

}  // namespace spoolflow::recording
