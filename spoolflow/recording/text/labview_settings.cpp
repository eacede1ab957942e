#include "spoolflow/recording/text/labview_settings.hpp"

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

}  // namespace spoolflow::recording
