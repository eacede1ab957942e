#pragma once
/// The texts of examples/valves/*.toml, built into the program so that presets need no files.
#include <span>
#include <string_view>

namespace spoolflow::rig {

struct PresetText {
  std::string_view name;  ///< the file's name without .toml
  std::string_view text;
};

[[nodiscard]] std::span<const PresetText> valve_preset_texts();

}  // namespace spoolflow::rig
