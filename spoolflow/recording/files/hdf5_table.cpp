#include "spoolflow/recording/files/hdf5_table.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <new>

#include <fmt/format.h>

#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/recording/files/hdf5_handle.hpp"
#include "spoolflow/recording/files/matrix_names.hpp"
#include "spoolflow/recording/files/vector_table.hpp"

namespace spoolflow::recording {
namespace {

constexpr std::size_t slab_rows = std::size_t{1} << 16;
constexpr std::size_t chunk_cache_bytes = std::size_t{16} << 20;  // a chunk is unpacked once, not once a slab
constexpr std::size_t longest_text = 4096;

/// A text attribute, of fixed or variable length; empty where there is none.
std::string text_attribute(hid_t object, const char* name) {
  if (H5Aexists(object, name) <= 0) return {};
  const Hdf5Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  if (!attribute.valid()) return {};
  const Hdf5Handle type(H5Aget_type(attribute.id()), H5Tclose);
  const Hdf5Handle space(H5Aget_space(attribute.id()), H5Sclose);
  if (!type.valid() || !space.valid() || H5Tget_class(type.id()) != H5T_STRING) return {};
  if (H5Sget_simple_extent_npoints(space.id()) != 1) return {};
  std::string out;
  if (H5Tis_variable_str(type.id()) > 0) {
    char* text = nullptr;
    if (H5Aread(attribute.id(), type.id(), &text) < 0 || text == nullptr) return {};
    out.assign(text, std::find(text, text + longest_text, '\0'));
    H5free_memory(text);
  } else {
    const std::size_t size = H5Tget_size(type.id());
    if (size == 0 || size > longest_text) return {};
    out.resize(size);
    if (H5Aread(attribute.id(), type.id(), out.data()) < 0) return {};
    out.resize(std::min(out.size(), out.find('\0')));
  }
  while (!out.empty() && out.back() == ' ') out.pop_back();
  return out;
}

/// A numeric attribute; `otherwise` where there is none.
double number_attribute(hid_t object, const char* name, double otherwise) {
  if (H5Aexists(object, name) <= 0) return otherwise;
  const Hdf5Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  if (!attribute.valid()) return otherwise;
  const Hdf5Handle space(H5Aget_space(attribute.id()), H5Sclose);
  double value = otherwise;
  if (!space.valid() || H5Sget_simple_extent_npoints(space.id()) != 1 ||
      H5Aread(attribute.id(), H5T_NATIVE_DOUBLE, &value) < 0) {
    return otherwise;
  }
  return value;
}

class Hdf5Table final : public VectorTable {
 public:
  explicit Hdf5Table(const std::filesystem::path& path) : VectorTable(path.string()) {
    silence_hdf5();
    file_handle_ = Hdf5Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
    if (!file_handle_.valid()) {
      throw RecordingError(
          fmt::format("{}: is damaged or cut short: HDF5 cannot open it; copy or record it again", file()));
    }
    if (H5Ovisit2(file_handle_.id(), H5_INDEX_NAME, H5_ITER_INC, &Hdf5Table::visit, this, H5O_INFO_BASIC) < 0) {
      throw RecordingError(fmt::format(
          "{}: is damaged or cut short: its table of contents cannot be read; copy or record it again", file()));
    }
  }

  [[nodiscard]] std::string unread() const override { return unread_; }

 protected:
  void copy(std::size_t column, std::uint64_t first, std::size_t count, double* out) override {
    Slab& slab = slabs_[column];
    while (count > 0) {
      if (first < slab.first || first >= slab.first + slab.values.size()) load(column, slab, first);
      const auto at = static_cast<std::size_t>(first - slab.first);
      const std::size_t part = std::min(count, slab.values.size() - at);
      std::copy_n(slab.values.data() + at, part, out);
      out += part;
      first += part;
      count -= part;
    }
  }

 private:
  struct Source {
    std::string path;
    int rank;
    bool is_row;
    std::uint64_t index;
  };
  struct Slab {
    Hdf5Handle dataset;
    Hdf5Handle space;
    double scale = 1.0;
    double offset = 0.0;
    std::uint64_t first = 0;
    std::vector<double> values;
  };

  static herr_t visit(hid_t file, const char* name, const H5O_info_t* info, void* table) {
    if (info->type != H5O_TYPE_DATASET) return 0;
    try {
      static_cast<Hdf5Table*>(table)->list(file, name);
    } catch (const std::bad_alloc&) {
      return -1;  // no exception may pass through the library
    }
    return 0;
  }

  void list(hid_t file_id, const std::string& path) {
    const Hdf5Handle dataset(H5Dopen2(file_id, path.c_str(), H5P_DEFAULT), H5Dclose);
    const Hdf5Handle type(dataset.valid() ? H5Dget_type(dataset.id()) : -1, H5Tclose);
    const Hdf5Handle space(dataset.valid() ? H5Dget_space(dataset.id()) : -1, H5Sclose);
    if (!type.valid() || !space.valid()) {
      unread_ = fmt::format("dataset '{}' is damaged or cut short", path);
      return;
    }
    const H5T_class_t kind = H5Tget_class(type.id());
    const int rank = H5Sget_simple_extent_ndims(space.id());
    std::array<hsize_t, 2> size{1, 1};
    if ((kind != H5T_FLOAT && kind != H5T_INTEGER) || rank < 1 || rank > 2 ||
        H5Sget_simple_extent_dims(space.id(), size.data(), nullptr) < 0) {
      unread_ =
          fmt::format("dataset '{}' is no vector or matrix of numbers; write one dataset of numbers a channel", path);
      return;
    }
    std::string unit = text_attribute(dataset.id(), "unit");
    if (unit.empty()) unit = text_attribute(dataset.id(), "units");
    const FileColumn column{path, path.substr(path.rfind('/') + 1), unit};
    for (MatrixPart& part : matrix_parts(column, size[0], size[1])) {
      sources_.push_back({path, rank, part.is_row, part.index});
      add(std::move(part.vector));
    }
  }

  void load(std::size_t column, Slab& slab, std::uint64_t first) {
    const Source& source = sources_[column];
    const auto fail = [&] {
      throw RecordingError(
          fmt::format("{}: dataset '{}' is damaged or cut short: it cannot be read from sample {} on; "
                      "copy or record it again",
                      file(), source.path, first + 1));
    };
    if (!slab.dataset.valid()) {
      const Hdf5Handle access(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose);
      H5Pset_chunk_cache(access.id(), H5D_CHUNK_CACHE_NSLOTS_DEFAULT, chunk_cache_bytes, H5D_CHUNK_CACHE_W0_DEFAULT);
      slab.dataset = Hdf5Handle(H5Dopen2(file_handle_.id(), source.path.c_str(), access.id()), H5Dclose);
      if (!slab.dataset.valid()) fail();
      slab.space = Hdf5Handle(H5Dget_space(slab.dataset.id()), H5Sclose);
      slab.scale = number_attribute(slab.dataset.id(), "scale_factor", 1.0);
      slab.offset = number_attribute(slab.dataset.id(), "add_offset", 0.0);
    }
    const std::uint64_t rows = std::min<std::uint64_t>(slab_rows, length(column) - first);
    // A vector lies along the first dimension, or as a row along the second.
    const std::array<hsize_t, 2> start{source.is_row ? source.index : first, source.is_row ? first : source.index};
    const std::array<hsize_t, 2> count{source.is_row ? 1 : rows, source.is_row ? rows : 1};
    const hsize_t in_memory = rows;
    const Hdf5Handle memory(H5Screate_simple(1, &in_memory, nullptr), H5Sclose);
    slab.values.resize(static_cast<std::size_t>(rows));
    if (!slab.space.valid() || !memory.valid() ||
        H5Sselect_hyperslab(slab.space.id(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr) < 0 ||
        H5Dread(slab.dataset.id(), H5T_NATIVE_DOUBLE, memory.id(), slab.space.id(), H5P_DEFAULT, slab.values.data()) <
            0) {
      fail();
    }
    if (slab.scale != 1.0 || slab.offset != 0.0) {
      for (double& value : slab.values) value = slab.scale * value + slab.offset;
    }
    slab.first = first;
  }

  Hdf5Handle file_handle_;
  std::vector<Source> sources_;
  std::map<std::size_t, Slab> slabs_;  ///< of the chosen columns
  std::string unread_;
};

}  // namespace

std::unique_ptr<SampleTable> open_hdf5_table(const std::filesystem::path& file) {
  return std::make_unique<Hdf5Table>(file);
}

}  // namespace spoolflow::recording
