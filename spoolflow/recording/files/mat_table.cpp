#include "spoolflow/recording/files/mat_table.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <matio.h>

#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/recording/files/declared_size.hpp"
#include "spoolflow/recording/files/hdf5_handle.hpp"
#include "spoolflow/recording/files/hdf5_other_files.hpp"
#include "spoolflow/recording/files/mat_elements.hpp"
#include "spoolflow/recording/files/matrix_names.hpp"
#include "spoolflow/recording/files/vector_table.hpp"

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

/// "log.signals(2).values" as the steps to it: variable, then field and element.
struct Step {
  std::string field;
  std::size_t element;
};

class MatTable final : public VectorTable {
 public:
  explicit MatTable(const std::filesystem::path& path)
      : VectorTable(path.string()), declared_(path.string(), std::filesystem::file_size(path)) {
    silence_hdf5();
    {  // of version 7.3, else it cannot be opened
      const Hdf5Handle hdf5(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
      if (hdf5.valid()) refuse_other_files(hdf5.id(), file());
    }
    Mat_LogInitFunc("spoolflow", [](int, char*) {});
    refuse_cut_mat_file(path);
    mat_.reset(Mat_Open(path.c_str(), MAT_ACC_RDONLY));
    if (!mat_) refuse_damaged("MATLAB's format is not found in it");
    while (const Variable variable{Mat_VarReadNextInfo(mat_.get())}) {
      if (variable->name != nullptr) list(*variable, variable->name, {{variable->name, 0}});
    }
    if (columns().empty() && unread_.empty()) refuse_damaged("no variable can be read from it");
  }

  [[nodiscard]] std::vector<UnreadPart> unread() const override { return unread_; }

  void copy(std::size_t column, std::uint64_t first, std::size_t count, double* out) override {
    const Source& source = sources_[column];
    const matvar_t& variable = loaded(source);
    const std::uint64_t rows = variable.dims[0];
    const Convert convert = converter(variable.class_type);
    if (source.part.is_row) {
      convert(variable.data, source.part.index + first * rows, rows, count, out);
    } else {
      convert(variable.data, source.part.index * rows + first, 1, count, out);
    }
  }

 private:
  struct Source {
    std::vector<Step> path;
    MatrixPart part;
    std::uint64_t rows;
    std::uint64_t columns;
  };

  [[noreturn]] void refuse_damaged(const std::string& what) const {
    throw RecordingError(
        fmt::format("{}: is damaged or cut short: {}; copy it again or save it again in MATLAB with "
                    "save(..., '-v7.3')",
                    file(), what));
  }

  void list(matvar_t& variable, const std::string& name, const std::vector<Step>& path) {
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
    } else if (converter(variable.class_type) == nullptr || variable.isComplex != 0 || variable.rank != 2 ||
               variable.dims == nullptr) {
      keep(unread_, {name, fmt::format("'{}' is no vector or matrix of real numbers", name)});
    } else {
      declared_.add(name, variable.dims[0], variable.dims[1], Mat_SizeOfClass(variable.class_type));
      const FileColumn column{name, path.back().field, {}};
      for (MatrixPart& part : matrix_parts(column, variable.dims[0], variable.dims[1])) {
        add(part.vector);
        sources_.push_back({path, std::move(part), variable.dims[0], variable.dims[1]});
      }
    }
  }

  void list_struct(matvar_t& variable, const std::string& name, const std::vector<Step>& path) {
    if (path.size() > deepest_struct || variable.dims == nullptr || variable.rank != 2) return;
    const std::size_t elements = variable.dims[0] * variable.dims[1];
    char* const* const fields = Mat_VarGetStructFieldnames(&variable);
    if (fields == nullptr) return;
    for (std::size_t element = 0; element < std::min(elements, most_structs); ++element) {
      const std::string prefix = elements > 1 ? fmt::format("{}({}).", name, element + 1) : name + ".";
      for (unsigned k = 0; k < Mat_VarGetNumberOfFields(&variable); ++k) {
        matvar_t* const field = Mat_VarGetStructFieldByIndex(&variable, k, element);
        if (field == nullptr || fields[k] == nullptr) continue;
        std::vector<Step> deeper = path;
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
    const bool whole = at != nullptr && at->data != nullptr && converter(at->class_type) != nullptr && at->rank == 2 &&
                       at->dims != nullptr && at->dims[0] == source.rows && at->dims[1] == source.columns &&
                       at->isComplex == 0 &&
                       at->nbytes == source.rows * source.columns * Mat_SizeOfClass(at->class_type);
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
