#include "spoolflow/recording/text/twincat_settings.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/recording/files/decimal_number.hpp"
#include "spoolflow/recording/text/csv_cells.hpp"
#include "spoolflow/recording/text/utf16.hpp"

namespace spoolflow::recording {
namespace {

constexpr std::string_view name_line = "Name";

bool is_export(std::string_view text) {
  const std::string_view first = text.substr(0, 2048);
  return first.starts_with(name_line) && first.size() > name_line.size() &&
         first.find("of export") != std::string_view::npos;
}

/// With empty ones, but for one behind a separator at the end.
std::size_t cells_in(std::string_view line, char delimiter) {
  if (line.ends_with(delimiter)) line.remove_suffix(1);
  return 1 + static_cast<std::size_t>(std::ranges::count(line, delimiter));
}

std::string unit_of_cell(std::string_view cell) {
  return cell == "(None)" ? std::string() : utf8_of(cell);
}

}  // namespace

TwincatSettings take_twincat_settings(std::string_view& text, const std::string& file) {
  TwincatSettings out;
  if (!is_export(text)) return out;
  out.delimiter = text[name_line.size()];
  std::vector<std::string_view> names, units;
  std::size_t cells_named = 0, cells_sampled = 0;
  while (text.find('\n') != std::string_view::npos) {
    std::string_view rest = text;
    const std::string_view line = take_line(rest);
    const std::vector<std::string_view> cells = cells_of(line, out.delimiter);
    cells_sampled = cells_in(line, out.delimiter);
    if (!cells.empty() && is_number(cells.front())) break;
    if (out.lines > 0 && !cells.empty() && cells.front() == name_line) names = cells, cells_named = cells_sampled;
    if (!cells.empty() && cells.front() == "Unit") units = cells;
    text = rest;
    ++out.lines;
  }
  if (names.size() < 2) {
    throw RecordingError(
        fmt::format("{}: is an export of TwinCAT Scope without a line of channel names or without samples; export it "
                    "again as CSV with its header",
                    file));
  }
  if (cells_named != cells_sampled) {
    throw RecordingError(
        fmt::format("{}: is an export of TwinCAT Scope with {} names above {} columns: a name or a number holds the "
                    "separator '{}'; export it again with tab as separator",
                    file, cells_named, cells_sampled, out.delimiter));
  }
  std::size_t time = 0;
  for (std::size_t k = 0; k < names.size(); ++k) {
    const bool is_time = names[k] == name_line;
    if (is_time) time = k;
    const std::string name = is_time ? "time" : utf8_of(names[k]);
    FileColumn& column = out.columns.emplace_back(FileColumn{name, name, is_time ? "ms" : ""});
    if (is_time) continue;
    if (k < units.size()) column.unit = unit_of_cell(units[k]);
    column.own_time = time;
  }
  return out;
}

}  // namespace spoolflow::recording
