#include "spoolflow/recording/files/csv_dialect.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include <fmt/format.h>

#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/recording/files/clock_time.hpp"
#include "spoolflow/recording/files/decimal_number.hpp"
#include "spoolflow/recording/files/header_name.hpp"
#include "spoolflow/recording/files/numbered_names.hpp"
#include "spoolflow/recording/files/utf16.hpp"
#include "spoolflow/units/unit.hpp"

namespace spoolflow::recording {
namespace {

constexpr std::size_t sampled_lines = 20;

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

/// The delimiter that cuts header and samples into equally many cells.
char delimiter_of(std::string_view header, std::string_view lines) {
  constexpr std::array<char, 3> candidates{'\t', ';', ','};
  char present = ',';
  for (auto candidate = candidates.rbegin(); candidate != candidates.rend(); ++candidate) {
    if (cells_of(header, *candidate).size() > 1) present = *candidate;
  }
  for (const char candidate : candidates) {
    const std::size_t cells = cells_of(header, candidate).size();
    bool everywhere = cells > 1;
    std::string_view rest = lines;
    for (std::size_t k = 0; k < sampled_lines && everywhere && !rest.empty(); ++k) {
      const std::string_view line = take_line(rest);
      if (rest.empty()) break;  // possibly cut short
      everywhere = is_blank(line) || line.starts_with('#') || cells_of(line, candidate).size() == cells;
    }
    if (everywhere) return candidate;
  }
  return present;
}

/// Cells of which most that say anything are numbers.
bool is_row_of_samples(const std::vector<std::string_view>& cells) {
  const auto filled = std::ranges::count_if(cells, [](std::string_view cell) { return !cell.empty(); });
  const auto numbers = std::ranges::count_if(cells, is_number);
  return cells.size() > 1 && numbers > 0 && 2 * numbers >= filled;
}

/// How many lines of title stand above the header: the first row of samples has, right above it or above a row of
/// units, a line of as many cells that are no numbers, and the file's first line is not cut as they are. 0 where
/// nothing tells so.
std::size_t title_lines(std::string_view beginning) {
  constexpr std::size_t most_lines = 100;
  std::vector<std::string_view> lines;
  for (std::string_view rest = beginning; !rest.empty() && lines.size() < most_lines;) {
    if (rest.find('\n') == std::string_view::npos) break;  // possibly cut short
    lines.push_back(take_line(rest));
    if (lines.back().starts_with("sep=")) return 0;  // says itself how it is written
  }
  for (const char delimiter : {'\t', ';', ','}) {
    std::vector<std::vector<std::string_view>> rows;
    for (const std::string_view line : lines) rows.push_back(cells_of(line, delimiter));
    for (std::size_t first = 1; first < rows.size(); ++first) {
      if (!is_row_of_samples(rows[first])) continue;
      std::size_t header = first - 1;
      if (header > 0 && is_units_row(rows[header]) && rows[header - 1].size() == rows[first].size()) --header;
      const bool names = rows[header].size() == rows[first].size() && !is_row_of_samples(rows[header]) &&
                         std::ranges::none_of(rows[header], is_number);
      if (!names) break;  // of this delimiter
      const bool is_title = std::ranges::none_of(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(header),
                                                 [&](const auto& row) { return row.size() == rows[first].size(); });
      if (header > 0 && is_title) return header;
      break;
    }
  }
  return 0;
}

/// LabVIEW's measurement files (.lvm): lines of settings, the last of them "***End_of_Header***", stand above the
/// names.
constexpr std::string_view labview_mark = "LabVIEW Measurement", labview_end = "***End_of_Header***";

/// Takes them off from the front, how many they are; the line of units among them, cell by cell.
std::size_t take_labview_settings(std::string_view& text, std::vector<std::string>& units) {
  if (!text.starts_with(labview_mark)) return 0;
  std::size_t lines = 0;
  for (bool more = text.find(labview_end) != std::string_view::npos; more; ++lines) {
    more = !text.starts_with(labview_end) || text.find(labview_end, labview_end.size()) != std::string_view::npos;
    const std::string_view line = take_line(text);
    if (!line.starts_with("Y_Unit_Label")) continue;
    for (const std::string_view cell : cells_of(line, line.find('\t') == std::string_view::npos ? ',' : '\t'))
      units.push_back(utf8_of(cell));
  }
  return lines;
}

void refuse_other_programs_exports(std::string_view beginning, const std::string& file) {
  const std::string_view first = beginning.substr(0, 2048);
  if (!first.starts_with("Name") || first.find("of export") == std::string_view::npos) return;
  throw RecordingError(fmt::format(
      "{}: is an export of TwinCAT Scope, whose first lines are settings and whose signals have a time each; cut "
      "all above the samples, write one line of names there, such as time_ms,current_A,position_mm, and "
      "leave one column of time",
      file));
}

/// The names that a header line holds.
std::vector<std::string_view> header_names(std::string_view header, const CsvDialect& dialect,
                                           const std::string& file) {
  std::vector<std::string_view> names = cells_of(header, dialect.delimiter);
  if (std::all_of(names.begin(), names.end(), is_number)) {
    throw RecordingError(
        fmt::format("{}, line {}: has no header, its first line is numbers; insert a first line that "
                    "names the columns, such as time_s,current_A,position_mm",
                    file, dialect.header_lines));
  }
  return names;
}

/// As the header writes them, doubled quotes as one.
std::vector<FileColumn> columns_named(const std::vector<std::string_view>& names) {
  std::vector<FileColumn> out;
  for (const std::string_view name : names) {
    std::string written(name);
    for (std::size_t at = 0; (at = written.find("\"\"", at)) != std::string::npos; ++at) written.erase(at, 1);
    written = utf8_of(written);
    out.push_back({written, written, {}});
  }
  return out;
}

/// Columns without a unit whose first sample is a time of the clock.
void count_clocks_in_seconds(CsvDialect& dialect, std::string_view samples) {
  std::string_view line;
  while (!samples.empty() && (is_blank(line) || line.starts_with('#'))) line = take_line(samples);
  const std::vector<std::string_view> first = cells_of(line, dialect.delimiter);
  for (std::size_t k = 0; k < std::min(first.size(), dialect.columns.size()); ++k) {
    if (dialect.columns[k].unit.empty() && read_clock_time(first[k])) dialect.columns[k].unit = "s";
  }
}

}  // namespace

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

bool header_is_whole(std::string_view beginning) {
  for (int lines = 0; lines < 2;) {
    if (beginning.find('\n') == std::string_view::npos) return false;
    const std::string_view line = take_line(beginning);
    const bool declares = line.starts_with("sep=") && line.size() == 5;
    if (!declares && !is_blank(line) && !line.starts_with('#')) ++lines;
  }
  return true;
}

CsvDialect read_csv_dialect(std::string_view beginning, const std::string& file) {
  if (beginning.empty()) throw RecordingError(fmt::format("{}: is empty; record it again or name another file", file));
  CsvDialect dialect;
  std::string_view rest = beginning;
  if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);

  refuse_other_programs_exports(rest, file);
  std::vector<std::string> labview_units;
  dialect.header_lines = take_labview_settings(rest, labview_units);
  for (std::size_t titles = dialect.header_lines > 0 ? 0 : title_lines(rest); titles > 0; --titles) {
    (void)take_line(rest);
    ++dialect.header_lines;
  }

  std::optional<char> declared;  // "sep=;", which spreadsheets write and obey
  const auto next_line = [&](std::string_view& text) {
    while (!text.empty()) {
      const std::string_view line = take_line(text);
      ++dialect.header_lines;
      if (line.starts_with("sep=") && line.size() == 5) {
        declared = line.back();
      } else if (!is_blank(line) && !line.starts_with('#')) {
        return line;
      }
    }
    return std::string_view{};
  };
  const std::string_view header = next_line(rest);
  if (header.empty()) {
    throw RecordingError(
        fmt::format("{}: holds no header line, only blank lines or comments; the first line names the "
                    "columns, such as time_s,current_A,position_mm",
                    file));
  }
  if (header.find('\r') != std::string_view::npos) {
    throw RecordingError(fmt::format("{}: its lines end with carriage returns only; save it with line feeds", file));
  }
  dialect.delimiter = declared.value_or(delimiter_of(header, rest));
  const std::vector<std::string_view> names = header_names(header, dialect, file);
  dialect.columns = columns_named(names);
  number_equal_names(dialect.columns);
  for (std::size_t k = 1; k < std::min(labview_units.size(), dialect.columns.size()); ++k)
    dialect.columns[k].unit = labview_units[k];
  if (dialect.header_lines > 1 && dialect.columns.front().name == "X_Value") dialect.columns.front().unit = "s";

  const CsvDialect without_units = dialect;
  std::string_view after = rest;
  const std::vector<std::string_view> second = cells_of(next_line(after), dialect.delimiter);
  if (second.size() <= names.size() && is_units_row(second)) {
    for (std::size_t k = 0; k < second.size(); ++k) dialect.columns[k].unit = utf8_of(second[k]);
    rest = after;
  } else {
    dialect = without_units;
  }
  dialect.header_bytes = beginning.size() - rest.size();
  count_clocks_in_seconds(dialect, rest);
  return dialect;
}

namespace {

/// How a cell writes its number, without quotes, spaces and its sign.
enum class Writing : std::uint8_t { other, whole, grouped };

/// `whole`: 1 to 3 digits, which grouping would leave as they are. `grouped`: groups of three digits behind `mark`.
Writing writing_of(std::string_view text, char mark) {
  constexpr std::string_view around = " \t\r\"-+";
  const std::size_t first = text.find_first_not_of(around);
  if (first == std::string_view::npos) return Writing::other;
  text = text.substr(first, text.find_last_not_of(around) - first + 1);
  const auto is_digits = [](std::string_view part) {
    return !part.empty() && std::ranges::all_of(part, [](char c) { return c >= '0' && c <= '9'; });
  };
  const std::string_view leading = text.substr(0, text.find(mark));
  if (!is_digits(leading) || leading.size() > 3 || leading.front() == '0') return Writing::other;
  if (leading.size() == text.size()) return Writing::whole;
  for (text.remove_prefix(leading.size()); !text.empty(); text.remove_prefix(4)) {
    if (text.size() < 4 || text.front() != mark || !is_digits(text.substr(1, 3))) return Writing::other;
  }
  return Writing::grouped;
}

}  // namespace

void DecimalSign::look_at(std::string_view lines, char delimiter) {
  constexpr std::array<char, 2> marks{'.', ','};
  while (!lines.empty() && marked_[0] + marked_[1] < enough) {
    std::string_view line = take_line(lines);
    if (line.starts_with('#')) continue;
    bool last = false;
    for (std::size_t column = 0; !last; ++column) {
      const CsvCell cell = take_cell(line, delimiter);
      last = cell.last;
      const auto found = columns_.find(column);
      if (found == columns_.end() || !is_number(cell.text)) continue;
      const bool has_both =
          std::ranges::all_of(marks, [&](char mark) { return cell.text.find(mark) != std::string_view::npos; });
      for (std::size_t m = 0; m < marks.size(); ++m) {
        Cells& cells = found->second[m];
        const Writing writing = writing_of(cell.text, marks[m]);
        const bool has_mark = cell.text.find(marks[m]) != std::string_view::npos;
        marked_[m] += has_mark && !has_both ? 1 : 0;
        cells.whole += writing == Writing::whole ? 1 : 0;
        cells.decimal += has_mark && writing != Writing::grouped ? 1 : 0;
        if (writing == Writing::grouped && ++cells.grouped == 1) cells.first = cell.text;
      }
    }
  }
}

std::optional<char> DecimalSign::found() const {
  if (marked_[0] + marked_[1] == 0) return std::nullopt;
  return marked_[1] > marked_[0] ? ',' : '.';
}

std::optional<GroupedCell> DecimalSign::grouped() const {
  constexpr std::size_t several = 2;
  for (const auto& [column, marks] : columns_) {
    const Cells& cells = marks[found() == ',' ? 1 : 0];
    if (cells.grouped > 0 && cells.decimal == 0 && cells.whole >= several) return GroupedCell{column, cells.first};
  }
  return std::nullopt;
}

}  // namespace spoolflow::recording
