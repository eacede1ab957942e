#pragma once
/// Where a table of samples stands in a text that may begin with other lines.
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace spoolflow::recording {

/// By lines from 0 on.
struct TablePlace {
  char delimiter;
  std::size_t samples;                  ///< the first row of them
  std::size_t width;                    ///< most cells of a row
  std::optional<std::size_t> header{};  ///< the line of names above; nothing where none is
  std::optional<std::size_t> units{};   ///< the row of units between
};

/// The longest stretch of lines of which most cells are numbers, where one that goes on to the end of `lines` comes
/// before others, cut by tab, semicolon or comma, or by single blanks where none of these cuts any, or by `declared`.
/// Its names are the nearest line above that has as many cells and no numbers; else one with more; else, as numpy
/// writes it, a comment. Nothing where no line is a row of samples.
[[nodiscard]] std::optional<TablePlace> find_table(const std::vector<std::string_view>& lines,
                                                   std::optional<char> declared);

/// Whether the first cell of a row says that units follow: "Vertical Units", "unit".
[[nodiscard]] bool labels_units(std::string_view cell);

/// A line without the signs of a comment (#, %, //) before it.
[[nodiscard]] std::string_view uncommented(std::string_view line);

}  // namespace spoolflow::recording
