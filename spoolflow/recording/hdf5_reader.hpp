#pragma once
#include <memory>

#include "spoolflow/recording/column_binding.hpp"
#include "spoolflow/recording/reader.hpp"

namespace spoolflow::recording {

/// An HDF5 file: numeric one-dimensional datasets (or N x 1, 1 x N) named by their path, `rig/time`; a text attribute
/// `unit` or `units` gives the unit where no channel map does. Packed data (netCDF's CF conventions, section 8.1) are
/// unpacked: value = scale_factor * stored + add_offset.
[[nodiscard]] std::unique_ptr<Reader> open_hdf5(const std::filesystem::path& file, const ReadOptions& options);
/// Its vectors by path, with their unit attributes.
[[nodiscard]] std::vector<FileColumn> columns_of_hdf5(const std::filesystem::path& file);

}  // namespace spoolflow::recording
