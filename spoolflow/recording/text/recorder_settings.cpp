#include "spoolflow/recording/text/recorder_settings.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/recording/files/decimal_number.hpp"
#include "spoolflow/recording/text/csv_cells.hpp"
#include "spoolflow/recording/text/utf16.hpp"

namespace spoolflow::recording {

namespace {

constexpr std::string_view first_words = "LabVIEW Measurement", last_words = "***End_of_Header***";

std::vector<double> numbers_of(const std::vector<std::string_view>& cells) {
  std::vector<double> out;
  for (const std::string_view cell : cells) {
    double value = 0;
    const bool read =
        read_number(cell, '.', value) == Digits::number || read_number(cell, ',', value) == Digits::number;
    if (read) out.push_back(value);
  }
  return out;
}

bool is_time(std::string_view cell) {
  return cell.empty() || cell == "Time";
}

}  // namespace

LabviewSettings take_labview_settings(std::string_view& text) {
  LabviewSettings out;
  if (!text.starts_with(first_words)) return out;
  for (bool more = text.find(last_words) != std::string_view::npos; more; ++out.lines) {
    more = !text.starts_with(last_words) || text.find(last_words, last_words.size()) != std::string_view::npos;
    const std::string_view line = take_line(text);
    std::vector<std::string_view> cells = cells_of(line, line.find('\t') == std::string_view::npos ? ',' : '\t');
    if (cells.size() < 2) continue;
    const std::string_view name = cells.front();
    cells.erase(cells.begin());
    if (name == "X_Columns") out.states_times = cells.front() == "No";
    if (name == "X_Dimension") out.over_time = std::ranges::all_of(cells, is_time);
    if (name == "X0") out.begin_s = numbers_of(cells);
    if (name == "Delta_X") out.step_s = numbers_of(cells);
    if (name != "Y_Unit_Label") continue;
    out.units.clear();
    for (const std::string_view cell : cells) out.units.push_back(utf8_of(cell));
  }
  return out;
}

std::size_t LabviewSettings::name_columns(std::vector<FileColumn>& columns) const {
  if (lines == 0) return 0;
  for (std::size_t k = 1; k < std::min(units.size() + 1, columns.size()); ++k) columns[k].unit = units[k - 1];
  std::vector<std::size_t> times;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (columns[k].leaf == "X_Value" && over_time) {
      columns[k].leaf = "time", columns[k].unit = "s";
      times.push_back(k);
    }
  }
  for (std::size_t k = 0; k < columns.size() && times.size() > 1; ++k)
    if (const auto after = std::ranges::upper_bound(times, k); after != times.begin() && *(after - 1) != k)
      columns[k].own_time = *(after - 1);
  return times.size();
}

std::optional<EvenStretch> LabviewSettings::stated_time(const std::string& file) const {
  if (!states_times) return std::nullopt;
  const auto differ = [](const std::vector<double>& values) {
    return values.empty() || std::ranges::any_of(values, [&](double value) { return value != values.front(); });
  };
  if (differ(begin_s) || differ(step_s) || !(step_s.front() > 0)) {
    throw RecordingError(fmt::format(
        "{}: states its times by X0 and Delta_X (X_Columns is No), which are missing or not the same for all "
        "channels; save it with X_Columns One or Multi",
        file));
  }
  return EvenStretch{0, begin_s.front(), step_s.front()};
}

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

RigolSettings take_rigol_settings(std::string_view& text, const std::string& file) {
  std::string_view rest = text;
  const std::vector<std::string_view> names = cells_of(take_line(rest), ',');
  const std::vector<std::string_view> units = cells_of(take_line(rest), ',');
  if (names.size() < 4 || names.front() != "X" || names.back() != "Increment" || units.empty() ||
      units.front() != "Sequence") {
    return {};
  }
  const std::size_t channels = names.size() - 2;
  RigolSettings out{2, {{"time", "time", "s"}}};
  const bool stated = units.size() == names.size() &&
                      read_number(units[channels], '.', out.time.begin_s) == Digits::number &&
                      read_number(units[channels + 1], '.', out.time.step_s) == Digits::number && out.time.step_s > 0;
  if (!stated) {
    throw RecordingError(fmt::format(
        "{}, line 2: states no first time and no time step > 0 below 'Start' and 'Increment', as exports of "
        "Rigol oscilloscopes do; export the recording again",
        file));
  }
  for (std::size_t k = 1; k < channels; ++k)
    out.columns.push_back({utf8_of(names[k]), utf8_of(names[k]), utf8_of(units[k])});
  text = rest;
  return out;
}

}  // namespace spoolflow::recording
