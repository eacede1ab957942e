#pragma once
#include <span>
#include <string_view>

namespace spoolflow::apps {

/// A file that travels inside the program.
struct EmbeddedFile {
  std::string_view name;  ///< "whole_size_6/valve.toml"
  std::string_view bytes;
};

/// Valve and scenario of each folder of examples/demo.
[[nodiscard]] std::span<const EmbeddedFile> demo_files();

}  // namespace spoolflow::apps
