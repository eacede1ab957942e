#pragma once
/// What stands above the samples in exports of TwinCAT Scope: lines about the export, then a block of settings of
/// which each line begins with its name, one cell a column. A column called "Name" holds the times [ms] of those behind
/// it, up to the next one. Offsets and factors are in the numbers already.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "spoolflow/recording/files/sample_table.hpp"

namespace spoolflow::recording {

struct TwincatSettings {
  std::uint64_t lines = 0;  ///< none: it is no such file
  char delimiter = '\t';
  std::vector<FileColumn> columns{};
};

/// Takes the settings off from the front. Throws RecordingError where no samples follow.
[[nodiscard]] TwincatSettings take_twincat_settings(std::string_view& text, const std::string& file);

}  // namespace spoolflow::recording
