#pragma once
#include <string>

#include <hdf5.h>

namespace spoolflow::recording {

/// An HDF5 file can say that its numbers stand in any other file that its reader may read: datasets with external
/// storage, virtual datasets, links into other files. None is followed. Throws RecordingError naming the first of them.
/// `name`: the file's, for messages.
void refuse_other_files(hid_t file, const std::string& name);

}  // namespace spoolflow::recording
