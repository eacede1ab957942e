#include "spoolflow/recording/text/foreign_text.hpp"

#include <algorithm>
#include <array>
#include <cctype>

#include <fmt/format.h>

#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/recording/files/decimal_number.hpp"
#include "spoolflow/recording/text/cell_unit.hpp"
#include "spoolflow/recording/text/csv_cells.hpp"

namespace spoolflow::recording {
namespace {

struct Kind {
  std::string_view what, remedy;
};
constexpr std::string_view export_as_csv =
    "export the recording as CSV: one line of names, such as time_s,current_A,position_mm, above the numbers";
constexpr Kind json{"JSON", export_as_csv};
constexpr Kind xml{"XML or HTML", export_as_csv};
constexpr Kind source{"source code", "name the recording that the program writes"};
constexpr Kind bus_log{"a log of bus messages",
                       "decode it with the bus's database, and save the signals as CSV or MDF 4"};
constexpr Kind lfs{"a pointer of Git LFS, not the file itself", "fetch the file by git lfs pull"};

bool begins_json(std::string_view text) {
  if (text.starts_with('{')) return true;
  if (!text.starts_with('[')) return false;
  const std::size_t next = text.find_first_not_of(" \t\r\n", 1);
  return next != std::string_view::npos &&
         std::string_view("[{\"-0123456789").find(text[next]) != std::string_view::npos;
}

bool begins_markup(std::string_view text) {
  if (!text.starts_with('<') || text.size() < 2 || text.find('>') == std::string_view::npos) return false;
  return text[1] == '?' || text[1] == '!' || std::isalpha(static_cast<unsigned char>(text[1])) != 0;
}

bool begins_source(std::string_view text) {
  constexpr std::array<std::string_view, 17> words{
      "#!",   "#include", "#pragma",   "#ifndef ", "#define ", "/*",     "\"\"\"",     "import ", "from ",
      "def ", "class ",   "function ", "package ", "using ",   "const ", "namespace ", "<?php"};
  const std::string_view line = text.substr(0, text.find('\n'));
  const bool cut = line.find_first_of(",;\t") != std::string_view::npos && !line.ends_with(';');  // a header's names
  return std::ranges::any_of(words, [&](std::string_view word) {
    const bool sign = word.front() == '#' || word.front() == '/';
    return text.starts_with(word) && (sign || !cut);
  });
}

bool begins_bus_log(std::string_view text) {
  return (text.starts_with("date ") || text.starts_with("base ")) &&
         text.substr(0, 1024).find("timestamps ") != std::string_view::npos;
}

/// More than a stray sign of a terminal or a serial line.
bool is_binary(std::string_view beginning) {
  constexpr std::size_t looked_at = 1024, few = 8;
  const auto control = [](char c) {
    return static_cast<unsigned char>(c) < ' ' && std::string_view("\t\n\v\f\r").find(c) == std::string_view::npos;
  };
  return std::ranges::count_if(beginning.substr(0, looked_at), control) > static_cast<std::ptrdiff_t>(few);
}

bool says_something(std::string_view cell) {
  double value = 0;
  return read_number(cell, '.', value) == Digits::not_a_number && !measures(cell);
}

}  // namespace

void refuse_other_kinds_of_text(std::string_view beginning, const std::string& file) {
  const std::size_t first = beginning.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return;
  const std::string_view text = beginning.substr(first);
  const Kind* found = nullptr;
  if (begins_json(text)) found = &json;
  if (begins_markup(text)) found = &xml;
  if (begins_source(text)) found = &source;
  if (begins_bus_log(text)) found = &bus_log;
  if (text.starts_with("version https://git-lfs")) found = &lfs;
  if (found != nullptr)
    throw RecordingError(fmt::format("{}: is {}, which is no recording; {}", file, found->what, found->remedy));
  if (is_binary(text)) {
    throw RecordingError(fmt::format(
        "{}: is not text and of no known format; save the recording as CSV, MAT, HDF5, TDMS or MDF 4", file));
  }
}

void refuse_text_without_numbers(const std::vector<std::string_view>& lines, char delimiter, const std::string& file) {
  std::size_t said = 0, blanks = 0, cells_of_text = 0;
  for (const std::string_view line : lines) {
    if (is_blank(line) || line.starts_with('#')) continue;
    const std::vector<std::string_view> cells = cells_of(line, delimiter);
    if (said++ > 0 && !std::ranges::any_of(cells, says_something)) return;  // one column of numbers, or empty rows
    cells_of_text += said > 1 ? 1 : 0;
    if (without_blanks(line).find("  ") != std::string_view::npos) ++blanks;
  }
  const bool one_word = said == 1 && !lines.empty() && cells_of(lines.front(), delimiter).size() == 1;
  if (cells_of_text == 0 && !one_word) return;
  throw RecordingError(fmt::format(
      "{}: holds no table: none of its first {} lines is a row of numbers that tab, semicolon or comma cut{}; {}", file,
      lines.size(), 2 * blanks > said ? ", and several blanks part its columns: write one sign between two" : "",
      export_as_csv));
}

}  // namespace spoolflow::recording
