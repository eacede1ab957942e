#pragma once
/// HDF5 files in bytes that somebody else has opened, so that a refused write reaches the caller in its own words.
#include <exception>

#include <hdf5.h>

#include "spoolflow/recording/files/hdf5_handle.hpp"
#include "spoolflow/recording/written_tables/table_output.hpp"

namespace spoolflow::recording {

/// What went wrong outside the library: it is kept here, and from then on the library writes into nothing, so that it
/// can close what it has open.
struct Hdf5Place {
  PlacedBytes* bytes;
  std::exception_ptr failure{};
};

/// A new HDF5 file there; `place` must outlive it. Throws std::runtime_error where the library refuses.
[[nodiscard]] Hdf5Handle create_hdf5_file(Hdf5Place& place);

}  // namespace spoolflow::recording
