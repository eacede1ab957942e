#pragma once
#include <span>
#include <string_view>

namespace spoolflow::rig {

/// A file that travels inside the program.
struct EmbeddedFile {
  std::string_view name;
  std::string_view bytes;
};

/// The valve files of examples/valves, so that presets need no files beside the program.
[[nodiscard]] std::span<const EmbeddedFile> valve_preset_files();

}  // namespace spoolflow::rig
