/// A virtual file driver after the library's public interface (H5FDpublic.h).
#include "spoolflow/recording/written_tables/hdf5_placed_file.hpp"

#include <algorithm>
#include <cstring>
#include <functional>
#include <new>
#include <stdexcept>

namespace spoolflow::recording {
namespace {

constexpr haddr_t farthest = haddr_t{1} << 62U;

/// The library knows it by its first member.
struct File {
  H5FD_t known{};
  Hdf5Place* place = nullptr;
  haddr_t allocated = 0;
  haddr_t end = 0;
};

File& file_of(H5FD_t* file) {
  return *reinterpret_cast<File*>(file);
}
const File& file_of(const H5FD_t* file) {
  return *reinterpret_cast<const File*>(file);
}

/// No exception may pass through the library: the first is kept.
template <class Work>
void attempt(Hdf5Place& place, const Work& work) {
  if (place.failure) return;
  try {
    work(*place.bytes);
  } catch (...) {
    place.failure = std::current_exception();
  }
}

H5FD_t* open(const char*, unsigned, hid_t access, haddr_t) {
  const void* const place = H5Pget_driver_info(access);
  File* const file = place == nullptr ? nullptr : new (std::nothrow) File();
  if (file == nullptr) return nullptr;
  std::memcpy(&file->place, place, sizeof(file->place));
  return &file->known;
}

herr_t close(H5FD_t* file) {
  delete &file_of(file);
  return 0;
}

int compare(const H5FD_t* a, const H5FD_t* b) {
  const std::less<const Hdf5Place*> before;
  const Hdf5Place *left = file_of(a).place, *right = file_of(b).place;
  return before(left, right) ? -1 : before(right, left) ? 1 : 0;
}

herr_t features(const H5FD_t*, unsigned long* flags) {
  *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
           H5FD_FEAT_AGGREGATE_SMALLDATA;
  return 0;
}

haddr_t allocated(const H5FD_t* file, H5FD_mem_t) {
  return file_of(file).allocated;
}
herr_t allocate(H5FD_t* file, H5FD_mem_t, haddr_t to) {
  file_of(file).allocated = to;
  return 0;
}
haddr_t end(const H5FD_t* file, H5FD_mem_t) {
  return file_of(file).end;
}

herr_t read(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t at, std::size_t size, void* out) {
  std::memset(out, 0, size);
  attempt(*file_of(file).place, [&](PlacedBytes& bytes) { bytes.read(at, {static_cast<std::uint8_t*>(out), size}); });
  return 0;
}

herr_t write(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t at, std::size_t size, const void* from) {
  attempt(*file_of(file).place, [&](PlacedBytes& bytes) {
    bytes.write(at, {static_cast<const std::uint8_t*>(from), size});
  });
  file_of(file).end = std::max(file_of(file).end, at + size);
  return 0;
}

/// Up to where the library has allocated: a file that ends before counts as cut short.
herr_t lengthen(H5FD_t* file, hid_t, hbool_t) {
  constexpr std::uint8_t zero = 0;
  const haddr_t to = file_of(file).allocated;
  if (to <= file_of(file).end) return 0;
  return write(file, H5FD_MEM_DRAW, H5P_DEFAULT, to - 1, 1, &zero);
}

hid_t driver() {
  static const H5FD_class_t about = [] {
    H5FD_class_t out{};
#if H5_VERSION_GE(1, 14, 0)
    out.version = H5FD_CLASS_VERSION;
    out.value = static_cast<H5FD_class_value_t>(512);  // from 512 on for tests and private drivers
#endif
    out.name = "spoolflow";
    out.maxaddr = farthest;
    out.fc_degree = H5F_CLOSE_WEAK;
    out.fapl_size = sizeof(Hdf5Place*);
    out.open = open;
    out.close = close;
    out.cmp = compare;
    out.query = features;
    out.get_eoa = allocated;
    out.set_eoa = allocate;
    out.get_eof = end;
    out.read = read;
    out.write = write;
    out.truncate = lengthen;
    return out;
  }();
  static const hid_t id = H5FDregister(&about);
  return id;
}

}  // namespace

Hdf5Handle create_hdf5_file(Hdf5Place& place) {
  silence_hdf5();
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  const Hdf5Place* const there = &place;
  Hdf5Handle file;
  if (H5Pset_driver(access.id(), driver(), &there) >= 0)
    file = Hdf5Handle(H5Fcreate("table.h5", H5F_ACC_TRUNC, H5P_DEFAULT, access.id()), H5Fclose);
  if (!file.valid()) throw std::runtime_error("the HDF5 library creates no file");
  return file;
}

}  // namespace spoolflow::recording
