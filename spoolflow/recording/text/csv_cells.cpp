#include "spoolflow/recording/text/csv_cells.hpp"

namespace spoolflow::recording {

bool is_blank(std::string_view text) {
  return text.find_first_not_of(" \t\r") == std::string_view::npos;
}

std::string_view without_blanks(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

std::vector<std::string_view> cells_of(std::string_view line, char delimiter) {
  std::vector<std::string_view> cells;
  for (bool last = false; !last;) {
    const CsvCell cell = take_cell(line, delimiter);
    cells.push_back(without_blanks(cell.text));
    last = cell.last;
  }
  while (!cells.empty() && cells.back().empty()) cells.pop_back();  // trailing delimiters
  return cells;
}

CsvCell take_cell(std::string_view& line, char delimiter) {
  std::size_t end = line.find(delimiter);
  const std::size_t start = line.find_first_not_of(' ');
  if (start != std::string_view::npos && line[start] == '"') {
    std::size_t close = line.find('"', start + 1);
    while (close != std::string_view::npos && line.substr(close + 1).starts_with('"'))
      close = line.find('"', close + 2);
    if (close != std::string_view::npos) end = line.find(delimiter, close);
  }
  std::string_view text = without_blanks(line.substr(0, end));
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
  const bool last = end == std::string_view::npos;
  line.remove_prefix(last ? line.size() : end + 1);
  return {text, last};
}

std::string_view take_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  std::string_view line = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

namespace {

/// Whether a cell begins with a quote that nothing closes.
bool leaves_quote_open(std::string_view line) {
  bool open = false, cell_begins = true;
  for (const char c : line) {
    if (open) {
      open = c != '"';
    } else if (c == '"' && cell_begins) {
      open = true;
    }
    if (c != ' ') cell_begins = c == ',' || c == ';' || c == '\t';
  }
  return open;
}

}  // namespace

std::string_view take_quoted_line(std::string_view& text) {
  constexpr int most_lines = 20;
  const std::string_view begun = text;
  const std::string_view first = take_line(text);
  if (!leaves_quote_open(first)) return first;
  std::string_view rest = text;
  for (int k = 1; k < most_lines && !rest.empty(); ++k) {
    const std::string_view line = take_line(rest);
    const auto length = static_cast<std::size_t>(line.data() + line.size() - begun.data());
    if (leaves_quote_open(begun.substr(0, length))) continue;
    text = rest;
    return begun.substr(0, length);
  }
  return first;
}

}  // namespace spoolflow::recording
