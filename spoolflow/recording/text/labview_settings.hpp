#pragma once
/// What stands above the names in LabVIEW's measurement files (.lvm): lines of settings, each begun by its name; the
/// last one of two blocks is "***End_of_Header***".
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "spoolflow/recording/files/sample_table.hpp"

namespace spoolflow::recording {

struct LabviewSettings {
  std::uint64_t lines = 0;                  ///< none: it is no such file
  std::vector<std::string> units{};         ///< of the columns behind the first
  std::vector<double> begin_s{}, step_s{};  ///< X0 and Delta_X, likewise
  bool over_time = true;                    ///< X_Dimension is Time
  bool states_times = false;                ///< the column of times is empty: X_Columns is No

  /// Their units, and which hold the times of the others; how many those are, none where it is no such file.
  std::size_t name_columns(std::vector<FileColumn>& columns) const;
  /// Times that no column holds. Throws RecordingError, which begins with `file`, where channels differ in theirs.
  [[nodiscard]] std::optional<EvenStretch> stated_time(const std::string& file) const;
};

/// Takes the settings off from the front.
[[nodiscard]] LabviewSettings take_labview_settings(std::string_view& text);

}  // namespace spoolflow::recording
