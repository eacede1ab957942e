#pragma once
/// What text files of recorders state beside their table: those of LabVIEW, of the TwinCAT scope and of Rigol
/// oscilloscopes.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "spoolflow/recording/files/sample_table.hpp"

namespace spoolflow::recording {

/// What stands above the names in LabVIEW's measurement files (.lvm): lines of settings, each begun by its name; the
/// last one of two blocks is "***End_of_Header***".
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

/// What stands above the samples in exports of TwinCAT Scope: lines about the export, then a block of settings of
/// which each line begins with its name, one cell a column. A column called "Name" holds the times [ms] of those behind
/// it, up to the next one. Offsets and factors are in the numbers already.
struct TwincatSettings {
  std::uint64_t lines = 0;  ///< none: it is no such file
  char delimiter = '\t';
  std::vector<FileColumn> columns{};
};

/// Takes the settings off from the front. Throws RecordingError where no samples follow.
[[nodiscard]] TwincatSettings take_twincat_settings(std::string_view& text, const std::string& file);

/// What stands above the samples in exports of Rigol oscilloscopes: "X,CH1,CH2,Start,Increment", and below these names
/// "Sequence,Volt,Volt,-6e-3,1e-5". The first column counts samples, of which the last two cells state the times [s].
struct RigolSettings {
  std::uint64_t lines = 0;            ///< none: it is no such file
  std::vector<FileColumn> columns{};  ///< the first is the time
  EvenStretch time{};                 ///< of the samples that the first column counts
};

/// Takes the settings off from the front. Throws RecordingError where they do not state the times.
[[nodiscard]] RigolSettings take_rigol_settings(std::string_view& text, const std::string& file);

}  // namespace spoolflow::recording
