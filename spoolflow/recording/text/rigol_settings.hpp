#pragma once
/// What stands above the samples in exports of Rigol oscilloscopes: "X,CH1,CH2,Start,Increment", and below these names
/// "Sequence,Volt,Volt,-6e-3,1e-5". The first column counts samples, of which the last two cells state the times [s].
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "spoolflow/recording/files/sample_table.hpp"

namespace spoolflow::recording {

struct RigolSettings {
  std::uint64_t lines = 0;            ///< none: it is no such file
  std::vector<FileColumn> columns{};  ///< the first is the time
  EvenStretch time{};                 ///< of the samples that the first column counts
};

/// Takes the settings off from the front. Throws RecordingError where they do not state the times.
[[nodiscard]] RigolSettings take_rigol_settings(std::string_view& text, const std::string& file);

}  // namespace spoolflow::recording
