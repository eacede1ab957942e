#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace spoolflow::exports {

/// A place that a text leaves open, such as "@VALVE@", and what stands there.
struct FilledPlace {
  std::string_view place;
  std::string content;
};

/// The text NAME.in of every exported folder, its open places filled wherever they stand. Throws std::logic_error where
/// the program holds none of that name.
[[nodiscard]] std::string exported_text(std::string_view name, const std::vector<FilledPlace>& places = {});

/// `name` as it may stand in a comment of C or Structured Text: nothing in it ends the comment or its line.
[[nodiscard]] std::string in_a_block_comment(std::string name);

}  // namespace spoolflow::exports
