#include "spoolflow/recording/text/csv_dialect.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include <fmt/format.h>

#include "spoolflow/recording/channels/byte_order_mark.hpp"
#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/recording/files/clock_time.hpp"
#include "spoolflow/recording/files/decimal_number.hpp"
#include "spoolflow/recording/files/header_name.hpp"
#include "spoolflow/recording/files/matrix_names.hpp"
#include "spoolflow/recording/text/cell_unit.hpp"
#include "spoolflow/recording/text/csv_cells.hpp"
#include "spoolflow/recording/text/foreign_text.hpp"
#include "spoolflow/recording/text/paired_times.hpp"
#include "spoolflow/recording/text/recorder_settings.hpp"
#include "spoolflow/recording/text/table_search.hpp"
#include "spoolflow/recording/text/utf16.hpp"
#include "spoolflow/units/unit.hpp"

namespace spoolflow::recording {
namespace {

constexpr std::size_t sampled_lines = 20;

/// The names that a header line holds.
std::vector<std::string_view> header_names(std::string_view header, const CsvDialect& dialect,
                                           const std::string& file) {
  std::vector<std::string_view> names = cells_of(uncommented(header), dialect.delimiter);
  if (std::ranges::all_of(names, is_number)) {
    throw RecordingError(
        fmt::format("{}, line {}: has no header, its first line is numbers; insert a first line that "
                    "names the columns, such as time_s,current_A,position_mm",
                    file, dialect.header_lines));
  }
  return names;
}

/// As the header writes them, doubled quotes as one; those without a name by their number.
std::vector<FileColumn> columns_named(const std::vector<std::string_view>& names) {
  std::vector<FileColumn> out;
  for (const std::string_view name : names) {
    std::string written(name);
    for (std::size_t at = 0; (at = written.find("\"\"", at)) != std::string::npos; ++at) written.erase(at, 1);
    std::erase(written, '\r');
    std::ranges::replace(written, '\n', ' ');
    written = name.empty() ? fmt::format("column {}", out.size() + 1) : utf8_of(written);
    out.push_back({written, written, {}});
  }
  number_equal_names(out);
  return out;
}

/// Columns whose name states no unit, by their first samples: a time of the clock counts in seconds, and a unit that
/// stands behind the number is the column's.
void find_units_in_samples(CsvDialect& dialect, std::string_view samples) {
  for (std::size_t k = 0; k < sampled_lines && samples.find('\n') != std::string_view::npos; ++k) {
    const std::string_view line = take_line(samples);
    if (is_blank(line) || line.starts_with('#')) continue;
    const std::vector<std::string_view> cells = cells_of(line, dialect.delimiter);
    for (std::size_t c = 0; c < std::min(cells.size(), dialect.columns.size()); ++c) {
      FileColumn& column = dialect.columns[c];
      if (!column.unit.empty()) continue;
      if (read_clock_time(cells[c])) {
        column.unit = "s";
      } else if (const auto unit = unit_in_cell(cells[c]); unit && !unit_of(column)) {
        column.unit = unit->name;
      }
    }
  }
}

/// The lines that are looked at; the last one may be cut short where it is the only one.
std::vector<std::string_view> first_lines(std::string_view text) {
  constexpr std::size_t most_lines = 400;
  std::vector<std::string_view> out;
  while (out.size() < most_lines && text.find('\n') != std::string_view::npos) out.push_back(take_quoted_line(text));
  if (out.size() < 2 && !text.empty()) out.push_back(text);
  return out;
}

/// "sep=;", which spreadsheets write and obey.
std::optional<char> declared_delimiter(std::string_view line) {
  line = without_blanks(line);
  if (line.size() == 7 && line.front() == '"' && line.back() == '"') line = line.substr(1, 5);
  return line.size() == 5 && (line.starts_with("sep=") || line.starts_with("SEP=")) ? std::optional(line.back())
                                                                                    : std::nullopt;
}

/// The header of a text in which no row of samples is seen: its first line, with units in the second.
TablePlace place_without_samples(const std::vector<std::string_view>& lines, std::optional<char> declared,
                                 const std::string& file) {
  std::vector<std::size_t> said;  // lines that are no comment
  for (std::size_t k = 0; k < lines.size(); ++k)
    if (!is_blank(lines[k]) && !lines[k].starts_with('#') && !declared_delimiter(lines[k])) said.push_back(k);
  if (said.empty()) {
    throw RecordingError(
        fmt::format("{}: holds no header line, only blank lines or comments; the first line names the "
                    "columns, such as time_s,current_A,position_mm",
                    file));
  }
  const std::string_view header = lines[said.front()];
  if (header.find('\r') != std::string_view::npos) {
    throw RecordingError(fmt::format("{}: its lines end with carriage returns only; save it with line feeds", file));
  }
  char delimiter = declared.value_or(',');
  for (const char candidate : {',', ';', '\t'})
    if (!declared && cells_of(header, candidate).size() > 1) delimiter = candidate;
  TablePlace out{delimiter, lines.size(), 0, said.front()};
  if (said.size() > 1) {
    const std::vector<std::string_view> second = cells_of(lines[said[1]], delimiter);
    if (second.size() <= cells_of(header, delimiter).size() && is_units_row(second)) out.units = said[1];
  }
  return out;
}

[[noreturn]] void refuse_without_names(const TablePlace& place, std::size_t lines_before, const std::string& file) {
  if (lines_before + place.samples == 0) {
    throw RecordingError(
        fmt::format("{}, line 1: has no header, its first line is numbers; insert a first line that "
                    "names the columns, such as time_s,current_A,position_mm",
                    file));
  }
  throw RecordingError(fmt::format(
      "{}, line {}: has no header, no line of {} names stands above the first row of numbers; insert a line "
      "there that names the columns, such as time_s,current_A,position_mm",
      file, lines_before + place.samples + 1, place.width));
}

}  // namespace

bool header_is_whole(std::string_view beginning) {
  for (int lines = 0; lines < 2;) {
    if (beginning.find('\n') == std::string_view::npos) return false;
    const std::string_view line = take_line(beginning);
    if (!declared_delimiter(line) && !is_blank(line) && !line.starts_with('#')) ++lines;
  }
  return true;
}

CsvDialect read_csv_dialect(std::string_view beginning, const std::string& file, bool runs_on) {
  if (beginning.empty()) throw RecordingError(fmt::format("{}: is empty; record it again or name another file", file));
  CsvDialect dialect;
  std::string_view rest = without_byte_order_mark(beginning);
  refuse_other_kinds_of_text(rest, file);
  if (TwincatSettings twincat = take_twincat_settings(rest, file); twincat.lines > 0) {
    constexpr std::size_t least_cells = 2;  // a time and its number
    return {.delimiter = twincat.delimiter,
            .columns = std::move(twincat.columns),
            .header_bytes = beginning.size() - rest.size(),
            .header_lines = twincat.lines,
            .least_cells = least_cells,
            .several_times = true,
            .end_word = "EOF"};
  }
  if (RigolSettings rigol = take_rigol_settings(rest, file); rigol.lines > 0) {
    return {.columns = std::move(rigol.columns),
            .header_bytes = beginning.size() - rest.size(),
            .header_lines = rigol.lines,
            .stated_time = rigol.time,
            .counts_samples = true};
  }
  const LabviewSettings labview = take_labview_settings(rest);
  dialect.header_lines = labview.lines;
  const std::vector<std::string_view> lines = first_lines(rest);
  std::optional<char> declared;
  for (const std::string_view line : lines) declared = declared ? declared : declared_delimiter(line);
  std::optional<TablePlace> place = find_table(lines, declared);
  if (!place) {
    place = place_without_samples(lines, declared, file);
    std::vector<std::string_view> whole = lines;
    if (lines.back().end() == beginning.end()) whole.pop_back();
    if (!runs_on) refuse_text_without_numbers(whole, place->delimiter, file);
  }
  if (!place->header) refuse_without_names(*place, dialect.header_lines, file);

  dialect.delimiter = place->delimiter;
  const std::vector<std::string_view> names = header_names(lines[*place->header], dialect, file);
  dialect.columns = columns_named(names);
  dialect.several_times = labview.name_columns(dialect.columns) > 1;
  dialect.stated_time = labview.stated_time(file);
  if (labview.lines > 0) {
    dialect.least_cells = dialect.columns.size() - (dialect.columns.back().leaf == "Comment" ? 1 : 0);
    dialect.next_block = "Channels";
  }
  if (place->units) {
    const std::vector<std::string_view> units = cells_of(uncommented(lines[*place->units]), dialect.delimiter);
    for (std::size_t k = labels_units(units.front()) ? 1 : 0; k < std::min(units.size(), names.size()); ++k)
      dialect.columns[k].unit = utf8_of(units[k]);
  }
  for (std::size_t last = std::max(*place->header, place->units.value_or(0)) + 1; last > 0; --last) {
    const std::string_view taken = take_quoted_line(rest);
    dialect.header_lines += 1 + static_cast<std::uint64_t>(std::ranges::count(taken, '\n'));
  }
  dialect.header_bytes = beginning.size() - rest.size();
  find_units_in_samples(dialect, rest);
  if (labview.lines == 0) dialect.several_times = pair_times(dialect.columns);
  return dialect;
}

}  // namespace spoolflow::recording
