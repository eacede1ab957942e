#include "spoolflow/recording/files/hdf5_unread.hpp"

#include <algorithm>
#include <array>
#include <exception>
#include <string_view>
#include <utility>
#include <vector>

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

namespace {

/// Numbers and names as The HDF Group registers them.
constexpr std::array<std::pair<H5Z_filter_t, std::string_view>, 17> filter_names{{
    {H5Z_FILTER_SZIP, "szip"},
    {305, "LZO"},
    {307, "bzip2"},
    {32000, "lzf"},
    {32001, "blosc"},
    {32003, "snappy"},
    {32004, "lz4"},
    {32008, "bitshuffle"},
    {32012, "CCSDS-123"},
    {32013, "zfp"},
    {32015, "zstd"},
    {32017, "sz"},
    {32018, "fcidecomp"},
    {32019, "jpeg"},
    {32024, "sz3"},
    {32026, "blosc2"},
    {H5Z_FILTER_NBIT, "n-bit"},
}};

std::string name_of(H5Z_filter_t filter, const char* written) {
  const auto* const known = std::ranges::find(filter_names, filter, &std::pair<H5Z_filter_t, std::string_view>::first);
  if (known != filter_names.end()) return fmt::format("{} (HDF5 filter {})", known->second, filter);
  return *written == '\0' ? fmt::format("HDF5 filter {}", filter) : fmt::format("{} (HDF5 filter {})", written, filter);
}

bool can_unpack(H5Z_filter_t filter) {
  unsigned how = 0;
  return H5Zfilter_avail(filter) > 0 &&
         (H5Zget_filter_info(filter, &how) < 0 || (how & H5Z_FILTER_CONFIG_DECODE_ENABLED) != 0);
}

/// Whether the writer left that filter out of every chunk, as it does where packing saves nothing.
bool is_left_out(hid_t dataset, unsigned filter) {
  constexpr hsize_t most = 1024;  // each is sought from the first on
  hsize_t chunks = 0;
  const Hdf5Handle space(H5Dget_space(dataset), H5Sclose);
  if (!space.valid() || H5Dget_num_chunks(dataset, space.id(), &chunks) < 0 || chunks > most) return false;
  for (hsize_t k = 0; k < chunks; ++k) {
    std::array<hsize_t, H5S_MAX_RANK> offset{};
    unsigned left_out = 0;
    haddr_t at = 0;
    hsize_t bytes = 0;
    if (H5Dget_chunk_info(dataset, space.id(), k, offset.data(), &left_out, &at, &bytes) < 0) return false;
    if ((left_out >> filter & 1U) == 0) return false;
  }
  return true;
}

/// The compression that this program cannot undo; empty: none.
std::string missing_filter(hid_t dataset) {
  const Hdf5Handle made(H5Dget_create_plist(dataset), H5Pclose);
  const int filters = made.valid() ? H5Pget_nfilters(made.id()) : 0;
  for (int k = 0; k < filters; ++k) {
    unsigned flags = 0;
    std::size_t values = 0;
    std::array<char, 64> written{};
    const H5Z_filter_t filter = H5Pget_filter2(made.id(), static_cast<unsigned>(k), &flags, &values, nullptr,
                                               written.size() - 1, written.data(), nullptr);
    if (filter < 0 || can_unpack(filter) || is_left_out(dataset, static_cast<unsigned>(k))) continue;
    return name_of(filter, written.data());
  }
  return {};
}

/// Names of a compound's members, the first ones.
std::string members_of(hid_t type) {
  constexpr unsigned most = 8;
  const int all = H5Tget_nmembers(type);
  std::string out;
  for (unsigned k = 0; k < static_cast<unsigned>(std::max(0, all)) && k < most; ++k) {
    char* const name = H5Tget_member_name(type, k);
    if (name == nullptr) continue;
    out += fmt::format("{}'{}'", out.empty() ? "" : ", ", name);
    H5free_memory(name);
  }
  return all > static_cast<int>(most) ? out + ", ..." : out;
}

/// h5py and numpy write complex numbers so.
bool is_complex(hid_t type) {
  return H5Tget_nmembers(type) == 2 && members_of(type) == "'r', 'i'";
}

std::string why_of_type(hid_t type) {
  switch (H5Tget_class(type)) {
    case H5T_FLOAT:
    case H5T_INTEGER:
      return {};
    case H5T_STRING:
      return "holds text; write its numbers as numbers";
    case H5T_COMPOUND:
      if (is_complex(type)) return "holds complex numbers; write the real numbers of one channel";
      return fmt::format("is a compound of {}; write each of them as a dataset of its own", members_of(type));
    case H5T_ENUM:
      return "holds booleans or an enumeration; write them as whole numbers";
    case H5T_VLEN:
      return "holds entries of any length; write one number a sample";
    case H5T_ARRAY:
      return "holds an array a sample; write each of its places as a dataset of its own";
    case H5T_REFERENCE:
      return "holds references to other objects; write the numbers themselves";
    default:
      return "holds no numbers; write one dataset of numbers a channel";
  }
}

}  // namespace

std::string why_unread(hid_t dataset, const std::string& path) {
  const auto because = [&path](const std::string& why) { return fmt::format("dataset '{}' {}", path, why); };
  const Hdf5Handle type(dataset >= 0 ? H5Dget_type(dataset) : H5I_INVALID_HID, H5Tclose);
  const Hdf5Handle space(dataset >= 0 ? H5Dget_space(dataset) : H5I_INVALID_HID, H5Sclose);
  if (!type.valid() || !space.valid()) return because("is damaged or cut short");
  if (const std::string why = why_of_type(type.id()); !why.empty()) return because(why);
  const int rank = H5Sget_simple_extent_ndims(space.id());
  if (rank < 1 || H5Sget_simple_extent_type(space.id()) != H5S_SIMPLE) {
    return because("is a single value, no samples; write one number a sample");
  }
  std::vector<hsize_t> size(static_cast<std::size_t>(rank));
  if (H5Sget_simple_extent_dims(space.id(), size.data(), nullptr) < 0) return because("is damaged or cut short");
  if (rank > 2) {
    return because(fmt::format("is an array of {}; write one vector a channel, or a matrix of one column a channel",
                               fmt::join(size, " x ")));
  }
  if (std::ranges::count(size, 0U) > 0) return because("is empty; record it again");
  if (const std::string filter = missing_filter(dataset); !filter.empty()) {
    return because(fmt::format(
        "is compressed by {}, which is not read; convert the file: h5repack -f GZIP=4 IN.h5 OUT.h5 (with that filter's "
        "plug-in, or in the program that wrote it), or record with gzip",
        filter));
  }
  return {};
}

}  // namespace spoolflow::recording
