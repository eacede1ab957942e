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

}  // namespace spoolflow::exports
