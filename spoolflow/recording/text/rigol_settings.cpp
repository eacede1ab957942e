#include "spoolflow/recording/text/rigol_settings.hpp"

#include <fmt/format.h>

#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/recording/files/decimal_number.hpp"
#include "spoolflow/recording/text/csv_cells.hpp"
#include "spoolflow/recording/text/utf16.hpp"

namespace spoolflow::recording {

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
