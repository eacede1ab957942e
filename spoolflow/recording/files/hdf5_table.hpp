#pragma once
#include <filesystem>
#include <memory>

#include "spoolflow/recording/files/vector_table.hpp"

namespace spoolflow::recording {

/// An HDF5 file: numeric datasets of any type by their path, `rig/time`: one-dimensional, N x 1 or 1 x N; of a matrix
/// each column as `rig/data(:,3)` (each row `rig/data(3,:)` where it is wider than tall). A text attribute `unit` or
/// `units` is the column's unit. Packed data (netCDF CF conventions, section 8.1) are unpacked: value = scale_factor *
/// stored + add_offset. The attributes wf_start_offset and wf_increment of a waveform (LabVIEW, TDMS) are its column's
/// beginning and step in seconds. Throws RecordingError where the file is damaged or holds no such dataset.
[[nodiscard]] std::unique_ptr<VectorTable> open_hdf5_table(const std::filesystem::path& file);

}  // namespace spoolflow::recording
