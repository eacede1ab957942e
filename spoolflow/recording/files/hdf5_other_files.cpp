#include "spoolflow/recording/files/hdf5_other_files.hpp"

#include <exception>

#include <fmt/format.h>

#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/recording/files/hdf5_handle.hpp"

namespace spoolflow::recording {
namespace {

struct Found {
  std::string name;
  const char* how = nullptr;
  std::exception_ptr failure;  ///< no exception may pass through the library
};

// `info` is what H5Ovisit2 gives: H5O_info_t, which HDF5 1.12 and later call H5O_info1_t.
herr_t look_at_object(hid_t file, const char* name, const auto* info, void* found) {
  if (info->type != H5O_TYPE_DATASET) return 0;
  Found& out = *static_cast<Found*>(found);
  try {
    const Hdf5Handle dataset(H5Dopen2(file, name, H5P_DEFAULT), H5Dclose);
    const Hdf5Handle made(dataset.valid() ? H5Dget_create_plist(dataset.id()) : -1, H5Pclose);
    if (!made.valid()) return 0;  // damaged: reported where it is listed
    if (H5Pget_layout(made.id()) == H5D_VIRTUAL) out.how = "is a virtual dataset";
    if (H5Pget_external_count(made.id()) > 0) out.how = "has external storage";
    if (out.how != nullptr) out.name = name;
  } catch (...) {
    out.failure = std::current_exception();
  }
  return out.how != nullptr || out.failure ? 1 : 0;
}

herr_t look_at_link(hid_t, const char* name, const H5L_info_t* info, void* found) {
  if (info->type == H5L_TYPE_HARD || info->type == H5L_TYPE_SOFT) return 0;
  Found& out = *static_cast<Found*>(found);
  try {
    out.name = name;
    out.how = "is an external link";
  } catch (...) {
    out.failure = std::current_exception();
  }
  return 1;
}

}  // namespace

void refuse_other_files(hid_t file, const std::string& name) {
  Found found;
  // What cannot be walked is reported where the datasets are listed.
  if (H5Lvisit(file, H5_INDEX_NAME, H5_ITER_INC, look_at_link, &found) == 0) {
    (void)H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_INC, look_at_object, &found, H5O_INFO_BASIC);
  }
  if (found.failure) std::rethrow_exception(found.failure);
  if (found.how == nullptr) return;
  throw RecordingError(
      fmt::format("{}: '{}' {}, so that its numbers stand in another file, and no other file is read; "
                  "copy them into this one (h5repack, h5copy)",
                  name, found.name, found.how));
}

}  // namespace spoolflow::recording
