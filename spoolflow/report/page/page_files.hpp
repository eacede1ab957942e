#pragma once
/// Script and style sheet of the pages, built in web/ and carried inside the program.
#include <span>
#include <string_view>

namespace spoolflow::report {

struct EmbeddedFile {
  std::string_view name;
  std::string_view bytes;
};

/// page.js and page.css of web/built.
[[nodiscard]] std::span<const EmbeddedFile> page_files();

}  // namespace spoolflow::report
