#pragma once
/// A valve's sensor as C++ for firmware: the sensor's headers as they are, and one header with the valve's numbers in
/// single precision. No algorithm is generated.
#include <string>
#include <string_view>
#include <vector>

#include "spoolflow/model/model.hpp"

namespace spoolflow::exports {

/// A file to be written; `name` is relative to the exported folder.
struct ExportedFile {
  std::string name;
  std::string content;
};

/// The header that holds the valve's numbers, and how it begins: a folder with such a file is an earlier export.
inline constexpr std::string_view cpp_model_name = "valve_model.hpp";
/// What the last export wrote, each file's SHA-256 before its name, as `sha256sum -c` reads it.
inline constexpr std::string_view cpp_record_name = "exported.sha256";
inline constexpr std::string_view cpp_model_mark = "// Made by `spoolflow export cpp`";

/// Throws std::invalid_argument where a number of the model does not fit into single precision.
[[nodiscard]] std::vector<ExportedFile> cpp_folder(const model::Model& model);
/// The file named cpp_record_name, of those files.
[[nodiscard]] ExportedFile record_of(const std::vector<ExportedFile>& files);

}  // namespace spoolflow::exports
