#pragma once
#include <span>
#include <string_view>

namespace spoolflow::apps {

/// A file that travels inside the program.
struct EmbeddedFile {
  std::string_view name;
  std::string_view bytes;
};

/// The campaign of examples/valve_a with its recordings and two operating runs (simulated).
[[nodiscard]] std::span<const EmbeddedFile> demo_recordings();

}  // namespace spoolflow::apps
