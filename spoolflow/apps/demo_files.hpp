#pragma once
#include <span>
#include <string_view>

namespace spoolflow::apps {

/// A file that travels inside the program.
struct EmbeddedFile {
  std::string_view name;
  std::string_view bytes;
};

/// The valve and the scenario of examples/demo.
[[nodiscard]] std::span<const EmbeddedFile> demo_files();

}  // namespace spoolflow::apps
