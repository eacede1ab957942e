#include "spoolflow/recording/mat_reader.hpp"

#include <array>
#include <fstream>
#include <map>

#include <fmt/format.h>
#include <matio.h>

#include "spoolflow/recording/column_table.hpp"
#include "spoolflow/recording/recording_error.hpp"

namespace spoolflow::recording {
namespace {

struct FileCloser {
  void operator()(mat_t* file) const { Mat_Close(file); }
};
struct VariableFreer {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};

template <class Value>
void append(std::vector<double>& out, const matvar_t& variable, std::size_t count) {
  const auto* values = static_cast<const Value*>(variable.data);
  for (std::size_t k = 0; k < count; ++k) out.push_back(static_cast<double>(values[k]));
}

/// A numeric row or column vector as doubles; nothing for anything else.
std::optional<std::vector<double>> vector_of(const matvar_t& variable) {
  if (variable.isComplex != 0 || variable.data == nullptr || variable.rank != 2) return std::nullopt;
  if (variable.dims[0] != 1 && variable.dims[1] != 1) return std::nullopt;
  const std::size_t count = variable.dims[0] * variable.dims[1];
  std::vector<double> out;
  out.reserve(count);
  switch (variable.data_type) {
    case MAT_T_DOUBLE:
      append<double>(out, variable, count);
      break;
    case MAT_T_SINGLE:
      append<float>(out, variable, count);
      break;
    case MAT_T_INT8:
      append<std::int8_t>(out, variable, count);
      break;
    case MAT_T_UINT8:
      append<std::uint8_t>(out, variable, count);
      break;
    case MAT_T_INT16:
      append<std::int16_t>(out, variable, count);
      break;
    case MAT_T_UINT16:
      append<std::uint16_t>(out, variable, count);
      break;
    case MAT_T_INT32:
      append<std::int32_t>(out, variable, count);
      break;
    case MAT_T_UINT32:
      append<std::uint32_t>(out, variable, count);
      break;
    case MAT_T_INT64:
      append<std::int64_t>(out, variable, count);
      break;
    case MAT_T_UINT64:
      append<std::uint64_t>(out, variable, count);
      break;
    default:
      return std::nullopt;
  }
  return out;
}

/// Every vector of the file under its name; structs are walked into.
void collect(matvar_t& variable, const std::string& name, std::map<std::string, std::vector<double>>& vectors,
             std::vector<std::string>& objects) {
  if (variable.class_type == MAT_C_STRUCT) {
    if (variable.data == nullptr || variable.dims == nullptr || variable.dims[0] * variable.dims[1] != 1) return;
    const unsigned fields = Mat_VarGetNumberOfFields(&variable);
    char* const* const names = Mat_VarGetStructFieldnames(&variable);
    for (unsigned k = 0; k < fields; ++k) {
      matvar_t* field = Mat_VarGetStructFieldByIndex(&variable, k, 0);
      if (field != nullptr) collect(*field, name + "." + names[k], vectors, objects);
    }
    return;
  }
  if (variable.class_type == MAT_C_OBJECT || variable.class_type == MAT_C_OPAQUE ||
      variable.class_type == MAT_C_FUNCTION) {
    objects.push_back(name);
    return;
  }
  if (auto vector = vector_of(variable)) vectors.emplace(name, std::move(*vector));
}

/// The last part of a struct path, by which <channel>_<unit> names are told inside a struct.
std::string leaf(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  return dot == std::string::npos ? name : name.substr(dot + 1);
}

/// A version 5 file is a header of 128 bytes and a chain of elements, each with its length: the chain must end with the
/// file. matio reads a file that was cut short as if zeros followed.
void refuse_cut_version_5(const std::filesystem::path& file) {
  constexpr std::uintmax_t header = 128;
  constexpr std::uintmax_t tag = 8;
  std::ifstream in(file, std::ios::binary);
  std::array<char, header> begin{};
  in.read(begin.data(), begin.size());
  const std::uintmax_t size = std::filesystem::file_size(file);
  const bool little_endian = begin[126] == 'I' && begin[127] == 'M';
  const bool version_5 = begin[little_endian ? 125 : 124] == 1;
  if (in.gcount() == static_cast<std::streamsize>(header) && !version_5) return;  // 7.3 is HDF5, which checks itself
  std::uintmax_t at = header;
  while (in && at < size) {
    std::array<unsigned char, tag> bytes{};
    in.seekg(static_cast<std::streamoff>(at));
    in.read(reinterpret_cast<char*>(bytes.data()), bytes.size());
    std::uintmax_t length = 0;
    for (std::size_t k = 0; k < 4; ++k) length |= std::uintmax_t{bytes[4 + k]} << (8 * (little_endian ? k : 3 - k));
    at += tag + length;
  }
  if (at != size) {
    throw RecordingError(
        fmt::format("{}: the MATLAB file is cut short ({} bytes, its contents need {}); copy or save it again",
                    file.string(), size, at));
  }
}

struct MatContents {
  std::map<std::string, std::vector<double>> vectors;
  std::vector<std::string> objects;  ///< what only MATLAB can read
};

MatContents contents_of_mat(const std::filesystem::path& file) {
  Mat_LogInitFunc("spoolflow", [](int, char*) {});  // matio's own complaints say less than ours
  const std::unique_ptr<mat_t, FileCloser> mat(Mat_Open(file.c_str(), MAT_ACC_RDONLY));
  if (!mat) {
    throw RecordingError(
        fmt::format("{}: is no readable MATLAB file (damaged or cut short?); save it again with "
                    "save(…, '-v7.3') or '-v7'",
                    file.string()));
  }
  refuse_cut_version_5(file);
  MatContents out;
  while (const std::unique_ptr<matvar_t, VariableFreer> variable{Mat_VarReadNext(mat.get())}) {
    if (variable->name != nullptr) collect(*variable, variable->name, out.vectors, out.objects);
  }
  if (!out.vectors.empty()) return out;
  throw RecordingError(
      out.objects.empty()
          ? fmt::format("{}: holds no numeric vectors that can be read (damaged or cut short?)", file.string())
          : fmt::format(
                "{}: \"{}\" is a table, timetable or other object, which MATLAB alone can read; save its columns as "
                "vectors, for instance s = table2struct(T, 'ToScalar', true); save(…, '-struct', 's')",
                file.string(), out.objects.front()));
}

}  // namespace

std::vector<FileColumn> columns_of_mat(const std::filesystem::path& file) {
  std::vector<FileColumn> columns;
  for (const auto& [name, vector] : contents_of_mat(file).vectors) columns.push_back({name, ""});
  return columns;
}

std::unique_ptr<Reader> open_mat(const std::filesystem::path& file, const ReadOptions& options) {
  const MatContents contents = contents_of_mat(file);
  std::vector<FileColumn> columns;
  std::vector<const std::vector<double>*> values;
  for (const auto& [name, vector] : contents.vectors) {
    columns.push_back({options.channels.sources.empty() ? leaf(name) : name, ""});
    values.push_back(&vector);
  }
  std::vector<BoundColumn> bound;
  for (const ColumnBinding& binding : bind_columns(columns, options, file.string())) {
    bound.push_back({binding, columns[binding.column].name, *values[binding.column]});
  }
  return serve_columns(std::move(bound), file.string());
}

}  // namespace spoolflow::recording
