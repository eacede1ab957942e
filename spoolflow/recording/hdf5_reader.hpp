#pragma once
#include <memory>

#include "spoolflow/recording/reader.hpp"

namespace spoolflow::recording {

/// An HDF5 file: numeric one-dimensional datasets (or N x 1, 1 x N) named by their path, `rig/time`; a text attribute
/// `unit` or `units` gives the unit where no channel map does.
[[nodiscard]] std::unique_ptr<Reader> open_hdf5(const std::filesystem::path& file, const ReadOptions& options);

}  // namespace spoolflow::recording
