#pragma once
/// Why a dataset of an HDF5 file is not read.
#include <string>

#include <hdf5.h>

namespace spoolflow::recording {

/// "holds text ...; write ...", with what to do; empty where the dataset is a vector or matrix of numbers that this
/// program can unpack. A dataset of which no sample is compressed by a filter that is missing here can be read.
[[nodiscard]] std::string why_unread(hid_t dataset, const std::string& path);

}  // namespace spoolflow::recording
