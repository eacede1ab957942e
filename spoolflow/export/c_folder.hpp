#pragma once
/// A valve's sensor for firmware houses without a C++ compiler: a static library for one core, its header in C99, a
/// flash page and a self-test.
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "spoolflow/export/cpp_folder.hpp"
#include "spoolflow/export/parameters/parameter_image.hpp"

namespace spoolflow::exports {

/// A core of microcontrollers, as `--target` names it, with the compiler's options for it.
struct FirmwareTarget {
  std::string_view name;
  std::string_view options;
};
[[nodiscard]] std::span<const FirmwareTarget> firmware_targets();
/// By its name, with or without "cortex-".
[[nodiscard]] std::optional<FirmwareTarget> firmware_target(std::string_view name);

/// Compiles the sources for a target: the bytes of an archive with every object file of theirs. Throws
/// std::runtime_error with the compiler's first words where that fails, or where no compiler is there.
using FirmwareCompiler =
    std::function<std::string(const std::vector<ExportedFile>& sources, const FirmwareTarget& target)>;
/// Empty where the add-on `cross` is not built in.
[[nodiscard]] FirmwareCompiler& firmware_compiler();

/// All files of the export. Throws as cpp_folder, parameter_image and the compiler do; std::runtime_error without a
/// compiler.
[[nodiscard]] std::vector<ExportedFile> c_folder(const model::Model& model, const FirmwareTarget& target,
                                                 const ImageContents& contents);

}  // namespace spoolflow::exports
