#pragma once
#include <string_view>

namespace spoolflow::live {

/// A file that travels inside the program.
struct EmbeddedFile {
  std::string_view name;
  std::string_view bytes;
};

}  // namespace spoolflow::live
