#pragma once
/// What the tests ask of a Markdown page.
#include <filesystem>
#include <string>
#include <vector>

namespace spoolflow::docs {

struct Page {
  std::filesystem::path file;
  std::vector<std::string> headings;    ///< without their marks
  std::vector<std::string> links;       ///< targets as written, outside of code
  std::vector<std::string> code_words;  ///< what stands between single backquotes, outside of blocks
};

/// Throws std::runtime_error where the file cannot be read, or where a code block does not end.
[[nodiscard]] Page read_page(const std::filesystem::path& file);
/// All *.md below a folder, sorted.
[[nodiscard]] std::vector<Page> pages_below(const std::filesystem::path& folder);
/// As GitHub names the place of a heading: "How it is" -> "how-it-is".
[[nodiscard]] std::string anchor(const std::string& heading);

}  // namespace spoolflow::docs
