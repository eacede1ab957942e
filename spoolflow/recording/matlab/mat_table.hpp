#pragma once
#include <filesystem>
#include <memory>

#include "spoolflow/recording/files/vector_table.hpp"

namespace spoolflow::recording {

/// A MATLAB file, version 5 or 7.3: numeric vectors of any class by their name, `variable` or `struct.field`
/// (`log.signals(2).values` in an array of structs), of a matrix each column as `name(:,3)` (each row `name(3,:)` where
/// it is wider than tall). A variable is read whole when the first of its
/// vectors is needed: MATLAB's compression allows no less. Throws RecordingError where
/// the file is damaged or holds no such vector.
[[nodiscard]] std::unique_ptr<VectorTable> open_mat_table(const std::filesystem::path& file);

}  // namespace spoolflow::recording
