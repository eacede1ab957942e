#pragma once
/// Which time stamps belong to a column of a file whose columns may be of different rates (HDF5, MATLAB).
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "spoolflow/recording/files/sample_table.hpp"

namespace spoolflow::recording {

/// When a column was sampled: by a column of time stamps, or at times that the file states of it.
struct ColumnClock {
  std::optional<std::size_t> time;  ///< column of the time stamps
  EvenTimes wave{};                 ///< where there is none
  std::uint64_t samples = 0;

  [[nodiscard]] bool operator==(const ColumnClock&) const = default;
};

/// The clock of `column`: its own_time, where the file says it. Else sought are columns that are called a time, are
/// none of `others` (columns known to be something else) and are equally long: beside it in its group or struct, then
/// in those around it, one that carries its name first, then `usual` (the time of the current); then the attributes
/// wf_start_offset and wf_increment of the column itself; then `usual`, wherever it stands; then the only one in the
/// file. Nothing where there is none. Throws RecordingError, which begins with `file`, where two of them could be it.
[[nodiscard]] std::optional<ColumnClock> clock_of(const SampleTable& table, std::size_t column,
                                                  std::optional<std::size_t> usual, std::span<const std::size_t> others,
                                                  const std::string& file);

}  // namespace spoolflow::recording
