#pragma once
/// Columns of other rates brought onto the time of the current.
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "spoolflow/recording/channel_binding.hpp"
#include "spoolflow/recording/files/sample_table.hpp"

namespace spoolflow::recording {

/// Opens the same file again.
using OpenAgain = std::function<std::unique_ptr<SampleTable>()>;

/// What was made of columns with one clock of their own.
struct Resampling {
  std::vector<std::string> columns;
  double from_Hz, to_Hz;  ///< 1 / median time step
  bool mean;              ///< over the step of the current's time; else linear interpolation
  double begin_s, end_s;  ///< of the columns; missing before and after
  bool late, early;       ///< begins after the current does, ends before it does
};

/// One line, empty of none: "resampled onto the time of 'rig/current_A' (1000 Hz): 'rig/p_bar' from 100 Hz by linear
/// interpolation".
[[nodiscard]] std::string sentence(const std::vector<Resampling>& resampled, const std::string& current);

struct OneClock {
  std::unique_ptr<SampleTable> table;
  std::string resampled{};  ///< sentence() of what was; empty where nothing was
};

/// The table itself where all `bound` columns are of one clock. Else one that reads those of others through further
/// openings of the file: slower columns interpolated linearly, faster ones as the mean over the step about each time of
/// the current; NaN before their first and after their last sample, and in gaps of more than ten of their steps. Memory
/// does not grow with the file. Throws RecordingError: no time to be found for a column, times that are missing or run
/// backwards, none in common with the current's.
[[nodiscard]] OneClock on_one_clock(std::unique_ptr<SampleTable> table, const std::vector<BoundColumn>& bound,
                                    const OpenAgain& open, const std::string& file);

}  // namespace spoolflow::recording
