#include "spoolflow/recording/matlab/mat_table.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <map>
#include <set>
#include <string_view>

#include <fmt/format.h>
#include <matio.h>

#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/recording/files/declared_size.hpp"
#include "spoolflow/recording/files/hdf5_handle.hpp"
#include "spoolflow/recording/files/hdf5_unread.hpp"
#include "spoolflow/recording/files/matrix_names.hpp"
#include "spoolflow/recording/files/vector_table.hpp"
#include "spoolflow/recording/matlab/mat_labels.hpp"

namespace spoolflow::recording {
namespace {

constexpr int deepest_struct = 8;
constexpr std::size_t most_structs = 256;  // in an array of structs; Simulink logs have one a signal

struct MatCloser {
  void operator()(mat_t* file) const { Mat_Close(file); }
};
struct VariableFreer {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using Variable = std::unique_ptr<matvar_t, VariableFreer>;

/// A MATLAB file of version 5 is a header of 128 bytes and a chain of elements, each with its length: the chain must
/// end where the file ends, which matio does not look at (it reads on as if zeros followed). Throws RecordingError.
/// Other versions pass.
void refuse_cut_mat_file(const std::filesystem::path& file) {
  constexpr std::uintmax_t header_bytes = 128;
  constexpr std::uintmax_t tag_bytes = 8;
  std::ifstream in(file, std::ios::binary);
  std::array<char, header_bytes> header{};
  in.read(header.data(), header.size());
  const std::uintmax_t size = std::filesystem::file_size(file);
  const bool little_endian = header[126] == 'I' && header[127] == 'M';
  const bool version_5 = header[little_endian ? 125 : 124] == 1;
  if (in && !version_5) return;
  std::uintmax_t at = header_bytes;
  while (in && at < size) {
    std::array<unsigned char, tag_bytes> tag{};
    in.seekg(static_cast<std::streamoff>(at));
    in.read(reinterpret_cast<char*>(tag.data()), tag.size());
    std::uintmax_t length = 0;
    for (std::size_t k = 0; k < 4; ++k) length |= std::uintmax_t{tag[4 + k]} << (8 * (little_endian ? k : 3 - k));
    at += tag_bytes + length;
  }
  if (at == size) return;
  throw RecordingError(
      fmt::format("{}: the MATLAB file is cut short or damaged: it has {} bytes, its variables need "
                  "{}; copy it or save it again",
                  file.string(), size, at));
}

template <class Value>
void convert(const void* data, std::uint64_t first, std::uint64_t stride, std::size_t count, double* out) {
  const Value* values = static_cast<const Value*>(data) + first;
  for (std::size_t k = 0; k < count; ++k) out[k] = static_cast<double>(values[k * stride]);
}

using Convert = void (*)(const void*, std::uint64_t, std::uint64_t, std::size_t, double*);

/// How the numbers of a class become doubles; null where it holds no numbers.
Convert converter(matio_classes numbers) {
  switch (numbers) {
    case MAT_C_DOUBLE:
      return convert<double>;
    case MAT_C_SINGLE:
      return convert<float>;
    case MAT_C_INT8:
      return convert<std::int8_t>;
    case MAT_C_UINT8:
      return convert<std::uint8_t>;
    case MAT_C_INT16:
      return convert<std::int16_t>;
    case MAT_C_UINT16:
      return convert<std::uint16_t>;
    case MAT_C_INT32:
      return convert<std::int32_t>;
    case MAT_C_UINT32:
      return convert<std::uint32_t>;
    case MAT_C_INT64:
      return convert<std::int64_t>;
    case MAT_C_UINT64:
      return convert<std::uint64_t>;
    default:
      return nullptr;
  }
}

/// A variable's numbers as a matrix. Of more dimensions than two the last one is taken for time, as Simulink logs the
/// signals of a matrix; rows 0 where it is no matrix and no such log.
struct Shape {
  std::uint64_t rows = 0, columns = 0;

  bool operator==(const Shape&) const = default;
};

Shape shape_of(const matvar_t& variable) {
  if (variable.dims == nullptr || variable.rank < 2) return {};
  if (variable.rank == 2) return {variable.dims[0], variable.dims[1]};
  constexpr std::uint64_t most = 256;
  std::uint64_t each = 1;
  for (int k = 0; k + 1 < variable.rank; ++k) {
    if (variable.dims[k] > most) return {};
    each *= variable.dims[k];
    if (each > most) return {};
  }
  const std::uint64_t samples = variable.dims[variable.rank - 1];
  return each < samples ? Shape{each, samples} : Shape{};
}

std::string size_of(const matvar_t& variable) {
  std::string out;
  for (int k = 0; variable.dims != nullptr && k < variable.rank; ++k)
    out += fmt::format("{}{}", k == 0 ? "" : " x ", variable.dims[k]);
  return out;
}

/// "holds text; ...", with what to do; empty where it is a vector or matrix of real numbers.
std::string why_unread(const matvar_t& variable) {
  switch (variable.class_type) {
    case MAT_C_CHAR:
      return "holds text; write its numbers as numbers";
    case MAT_C_CELL:
      return "is a cell array; write its numbers as a matrix (cell2mat)";
    case MAT_C_SPARSE:
      return "is a sparse matrix; write it whole (full)";
    case MAT_C_EMPTY:
      return "is empty; record it again";
    default:
      break;
  }
  if (converter(variable.class_type) == nullptr) return "holds no numbers; write one vector of numbers a channel";
  if (variable.isComplex != 0) return "holds complex numbers; write the real numbers of one channel";
  for (int k = 0; variable.dims != nullptr && k < variable.rank; ++k) {
    if (variable.dims[k] == 0) return "is empty; record it again";
  }
  if (shape_of(variable).rows > 0) return {};
  return fmt::format("is an array of {}; write one vector a channel, or a matrix of one column a channel",
                     size_of(variable));
}

bool named_as_time(std::string_view field) {
  return field == "time" || field == "Time";
}

class MatTable final : public VectorTable {
 public:
  explicit MatTable(const std::filesystem::path& path)
      : VectorTable(path.string()), declared_(path.string(), std::filesystem::file_size(path)) {
    silence_hdf5();
    {  // of version 7.3, else it cannot be opened
      const Hdf5Handle hdf5(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
      if (hdf5.valid()) refuse_other_files(hdf5.id(), file());
    }
    Mat_LogInitFunc("spoolflow", [](int, auto* /*char, in newer versions const char*/) {});
    refuse_cut_mat_file(path);
    mat_.reset(Mat_Open(path.c_str(), MAT_ACC_RDONLY));
    if (!mat_) refuse_damaged("MATLAB's format is not found in it");
  }

  void look() override {
    while (const Variable variable{Mat_VarReadNextInfo(mat_.get())}) {
      if (variable->name != nullptr) list(*variable, variable->name, {{variable->name, 0}});
    }
    if (sources_.empty() && unread_.empty()) refuse_damaged("no variable can be read from it");
    label();
    for (const Source& source : sources_) add(source.part.vector);
  }

  [[nodiscard]] std::vector<UnreadPart> unread() const override { return unread_; }

  void copy(std::size_t column, std::uint64_t first, std::size_t count, double* out) override {
    const Source& source = sources_[column];
    const matvar_t& variable = loaded(source);
    const std::uint64_t rows = source.shape.rows;
    const Convert convert = converter(variable.class_type);
    if (source.part.is_row) {
      convert(variable.data, source.part.index + first * rows, rows, count, out);
    } else {
      convert(variable.data, source.part.index * rows + first, 1, count, out);
    }
  }

 private:
  struct Source {
    std::vector<MatStep> path;
    MatrixPart part;
    std::size_t number, parts;  ///< which part of how many
    Shape shape;
  };

  [[noreturn]] void refuse_damaged(const std::string& what) const {
    throw RecordingError(
        fmt::format("{}: is damaged or cut short: {}; copy it again or save it again in MATLAB with "
                    "save(..., '-v7.3')",
                    file(), what));
  }

  void list(matvar_t& variable, const std::string& name, const std::vector<MatStep>& path) {
    if (variable.class_type == MAT_C_STRUCT) {
      list_struct(variable, name, path);
    } else if (variable.class_type == MAT_C_OBJECT || variable.class_type == MAT_C_OPAQUE ||
               variable.class_type == MAT_C_FUNCTION) {
      keep(unread_,
           {name,
            fmt::format("'{0}' is a table, timetable, timeseries or other object, which only MATLAB can read: save "
                        "its columns as vectors, with s = table2struct({0}, 'ToScalar', true); save(..., '-struct', "
                        "'s'), of a timeseries with t = {0}.Time; x = {0}.Data",
                        name)});
    } else if (const std::string why = why_unread(variable); !why.empty()) {
      keep(unread_, {name, fmt::format("'{}' {}", name, why)});
    } else {
      const Shape shape = shape_of(variable);
      declared_.add(name, shape.rows, shape.columns, Mat_SizeOfClass(variable.class_type));
      const FileColumn column{name, path.back().field, {}};
      const std::vector<MatrixPart> parts = matrix_parts(column, shape.rows, shape.columns);
      for (std::size_t k = 0; k < parts.size(); ++k) sources_.push_back({path, parts[k], k, parts.size(), shape});
    }
  }

  /// Columns of structs are called what the structs say of them. Reads those structs whole, one at a time.
  void label() {
    std::set<std::string> labelled;
    for (const Source& source : sources_) {
      if (source.path.size() > 1 && is_labelled_field(source.path.back().field))
        labelled.insert(source.path.front().field);
    }
    Variable whole;
    std::string read;
    for (Source& source : sources_) {
      if (source.path.size() < 2 || !labelled.contains(source.path.front().field)) continue;
      if (const std::string& wanted = source.path.front().field; wanted != read) {
        whole.reset();  // not both in memory
        whole.reset(Mat_VarRead(mat_.get(), wanted.c_str()));
        read = wanted;
      }
      if (!whole) continue;
      FileColumn& column = source.part.vector.column;
      const std::string& field = source.path.back().field;
      if (named_as_time(field)) column.unit = unit_of_time_in(*whole, source.path);
      if (!is_labelled_field(field)) continue;
      const MatLabel label = label_of(*whole, source.path, source.number, source.parts);
      column.unit = label.unit;
      if (label.name.empty()) continue;
      column.leaf = label.name + (label.of_all ? column.leaf.substr(field.size()) : "");
    }
  }

  void list_struct(matvar_t& variable, const std::string& name, const std::vector<MatStep>& path) {
    if (path.size() > deepest_struct || variable.dims == nullptr || variable.rank != 2) return;
    const std::size_t elements = variable.dims[0] * variable.dims[1];
    char* const* const fields = Mat_VarGetStructFieldnames(&variable);
    if (fields == nullptr) return;
    const unsigned count = Mat_VarGetNumberOfFields(&variable);
    const bool labelled = std::any_of(fields, fields + count,
                                      [](const char* field) { return field != nullptr && is_labelled_field(field); });
    for (std::size_t element = 0; element < std::min(elements, most_structs); ++element) {
      const std::string prefix = elements > 1 ? fmt::format("{}({}).", name, element + 1) : name + ".";
      for (unsigned k = 0; k < count; ++k) {
        matvar_t* const field = Mat_VarGetStructFieldByIndex(&variable, k, element);
        if (field == nullptr || fields[k] == nullptr || (labelled && is_annotation(fields[k]))) continue;
        std::vector<MatStep> deeper = path;
        deeper.push_back({fields[k], element});
        list(*field, prefix + fields[k], deeper);
      }
    }
  }

  /// The matrix with its numbers: its variable is read when the first of its columns is needed.
  const matvar_t& loaded(const Source& source) {
    Variable& variable = loaded_[source.path.front().field];
    if (!variable) variable.reset(Mat_VarRead(mat_.get(), source.path.front().field.c_str()));
    matvar_t* at = variable.get();
    for (std::size_t k = 1; k < source.path.size() && at != nullptr; ++k) {
      if (at->class_type != MAT_C_STRUCT) at = nullptr;
      if (at != nullptr) {
        at = Mat_VarGetStructFieldByName(at, source.path[k].field.c_str(), source.path[k].element);
      }
    }
    const bool whole = at != nullptr && at->data != nullptr && converter(at->class_type) != nullptr &&
                       shape_of(*at) == source.shape && at->isComplex == 0 &&
                       at->nbytes == source.shape.rows * source.shape.columns * Mat_SizeOfClass(at->class_type);
    if (!whole) refuse_damaged(fmt::format("'{}' cannot be read", source.part.vector.column.name));
    return *at;
  }

  std::unique_ptr<mat_t, MatCloser> mat_;
  std::vector<Source> sources_;
  std::map<std::string, Variable> loaded_;
  std::vector<UnreadPart> unread_;
  DeclaredSize declared_;
};

}  // namespace

std::unique_ptr<VectorTable> open_mat_table(const std::filesystem::path& file) {
  return std::make_unique<MatTable>(file);
}

}  // namespace spoolflow::recording
