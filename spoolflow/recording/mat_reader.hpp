#pragma once
#include <memory>

#include "spoolflow/recording/column_binding.hpp"
#include "spoolflow/recording/reader.hpp"

namespace spoolflow::recording {

/// A MATLAB file, version 5 or 7.3: numeric vectors at the top level or in structs, named `variable` or `struct.field`.
[[nodiscard]] std::unique_ptr<Reader> open_mat(const std::filesystem::path& file, const ReadOptions& options);
/// Its vectors by full name.
[[nodiscard]] std::vector<FileColumn> columns_of_mat(const std::filesystem::path& file);

}  // namespace spoolflow::recording
