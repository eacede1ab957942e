#pragma once
/// Lines of text cut into cells.
#include <string_view>
#include <vector>

namespace spoolflow::recording {

[[nodiscard]] bool is_blank(std::string_view text);
[[nodiscard]] std::string_view without_blanks(std::string_view text);

/// Takes the next cell off a line (quotes removed from cells that begin and end with one); `line` is empty after the
/// last cell, and `last` distinguishes it from an empty cell that follows.
struct CsvCell {
  std::string_view text;
  bool last;
};
[[nodiscard]] CsvCell take_cell(std::string_view& line, char delimiter);

/// All cells of a line but empty ones at its end.
[[nodiscard]] std::vector<std::string_view> cells_of(std::string_view line, char delimiter);

/// Takes the next line off, without its line end.
[[nodiscard]] std::string_view take_line(std::string_view& text);

/// The same of a line above samples, whose cells in quotes may go on in the next lines, as names of spreadsheets do.
[[nodiscard]] std::string_view take_quoted_line(std::string_view& text);

}  // namespace spoolflow::recording
