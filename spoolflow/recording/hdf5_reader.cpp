#include "spoolflow/recording/hdf5_reader.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>
#include <hdf5.h>

#include "spoolflow/recording/column_table.hpp"
#include "spoolflow/recording/recording_error.hpp"

namespace spoolflow::recording {
namespace {

/// An HDF5 identifier that closes itself.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  [[nodiscard]] hid_t id() const { return id_; }
  [[nodiscard]] bool valid() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// Length of a numeric vector dataset; nothing for anything else.
std::optional<std::size_t> vector_length(hid_t dataset) {
  const Handle type(H5Dget_type(dataset), H5Tclose);
  const Handle space(H5Dget_space(dataset), H5Sclose);
  const H5T_class_t kind = type.valid() ? H5Tget_class(type.id()) : H5T_NO_CLASS;
  if (!space.valid() || (kind != H5T_FLOAT && kind != H5T_INTEGER)) return std::nullopt;
  const int rank = H5Sget_simple_extent_ndims(space.id());
  std::array<hsize_t, 2> dims{1, 1};
  if (rank < 1 || rank > 2 || H5Sget_simple_extent_dims(space.id(), dims.data(), nullptr) < 0) return std::nullopt;
  if (rank == 2 && dims[0] != 1 && dims[1] != 1) return std::nullopt;
  return static_cast<std::size_t>(dims[0] * dims[1]);
}

/// A text attribute, of fixed or variable length; empty where there is none.
std::string text_attribute(hid_t object, const char* name) {
  if (H5Aexists(object, name) <= 0) return {};
  const Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  const Handle type(attribute.valid() ? H5Aget_type(attribute.id()) : -1, H5Tclose);
  if (!type.valid() || H5Tget_class(type.id()) != H5T_STRING) return {};
  if (H5Tis_variable_str(type.id()) > 0) {
    char* text = nullptr;
    if (H5Aread(attribute.id(), type.id(), &text) < 0 || text == nullptr) return {};
    std::string out(text);
    H5free_memory(text);
    return out;
  }
  std::string out(H5Tget_size(type.id()), '\0');
  if (H5Aread(attribute.id(), type.id(), out.data()) < 0) return {};
  out.resize(std::min(out.size(), out.find('\0')));
  while (!out.empty() && out.back() == ' ') out.pop_back();
  return out;
}

/// A numeric attribute; `otherwise` where there is none.
double number_attribute(hid_t object, const char* name, double otherwise) {
  if (H5Aexists(object, name) <= 0) return otherwise;
  const Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  double value = otherwise;
  if (!attribute.valid() || H5Aread(attribute.id(), H5T_NATIVE_DOUBLE, &value) < 0) return otherwise;
  return value;
}

struct Found {
  std::vector<FileColumn> columns;
  std::vector<std::string> paths;
};

herr_t visit(hid_t file, const char* name, const H5O_info_t* info, void* found) {
  if (info->type != H5O_TYPE_DATASET) return 0;
  const Handle dataset(H5Dopen2(file, name, H5P_DEFAULT), H5Dclose);
  if (!dataset.valid() || !vector_length(dataset.id())) return 0;
  std::string unit = text_attribute(dataset.id(), "unit");
  if (unit.empty()) unit = text_attribute(dataset.id(), "units");
  auto& out = *static_cast<Found*>(found);
  out.columns.push_back({name, unit});
  out.paths.emplace_back(name);
  return 0;
}

std::vector<double> read_vector(hid_t file, const std::string& path, const std::string& file_name) {
  const Handle dataset(H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose);
  const auto length = dataset.valid() ? vector_length(dataset.id()) : std::nullopt;
  std::vector<double> values(length.value_or(0));
  if (!length || H5Dread(dataset.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) {
    throw RecordingError(fmt::format("{}: dataset \"{}\" cannot be read (damaged or cut short?); write the file again",
                                     file_name, path));
  }
  const double scale = number_attribute(dataset.id(), "scale_factor", 1);
  const double offset = number_attribute(dataset.id(), "add_offset", 0);
  if (scale != 1 || offset != 0) {
    for (double& value : values) value = scale * value + offset;
  }
  return values;
}

std::string leaf(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? path : path.substr(slash + 1);
}

/// The file and its vectors.
struct Opened {
  std::unique_ptr<Handle> file;
  Found found;
};

Opened open_file(const std::filesystem::path& file) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // HDF5's own complaints say less than ours
  Opened out{std::make_unique<Handle>(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose), {}};
  if (!out.file->valid()) {
    throw RecordingError(
        fmt::format("{}: is no readable HDF5 file (damaged or cut short?); write it again", file.string()));
  }
  if (H5Ovisit2(out.file->id(), H5_INDEX_NAME, H5_ITER_INC, visit, &out.found, H5O_INFO_BASIC) < 0 ||
      out.found.columns.empty()) {
    throw RecordingError(fmt::format("{}: holds no numeric one-dimensional datasets that can be read", file.string()));
  }
  return out;
}

}  // namespace

std::vector<FileColumn> columns_of_hdf5(const std::filesystem::path& file) {
  return open_file(file).found.columns;
}

std::unique_ptr<Reader> open_hdf5(const std::filesystem::path& file, const ReadOptions& options) {
  Opened opened = open_file(file);
  Found& found = opened.found;
  if (options.channels.sources.empty()) {
    for (FileColumn& column : found.columns) column.name = leaf(column.name);
  }
  ReadOptions rooted = options;
  for (auto& [channel, source] : rooted.channels.sources) {
    if (source.column.starts_with('/')) source.column.erase(0, 1);
  }
  std::vector<BoundColumn> bound;
  for (const ColumnBinding& binding : bind_columns(found.columns, rooted, file.string())) {
    bound.push_back({binding, found.columns[binding.column].name,
                     read_vector(opened.file->id(), found.paths[binding.column], file.string())});
  }
  return serve_columns(std::move(bound), file.string());
}

}  // namespace spoolflow::recording
