#pragma once
/// Why a dataset of an HDF5 file is not read.
#include <string>

#include <hdf5.h>

namespace spoolflow::recording {

/// An HDF5 file can say that its numbers stand in any other file that its reader may read: datasets with external
/// storage, virtual datasets, links into other files. None is followed. Throws RecordingError naming the first of them.
/// `name`: the file's, for messages.
void refuse_other_files(hid_t file, const std::string& name);

/// "holds text ...; write ...", with what to do; empty where the dataset is a vector or matrix of numbers that this
/// program can unpack. A dataset of which no sample is compressed by a filter that is missing here can be read.
[[nodiscard]] std::string why_unread(hid_t dataset, const std::string& path);

}  // namespace spoolflow::recording
