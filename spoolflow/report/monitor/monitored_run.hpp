#pragma once
#include <string>
#include <vector>

#include "spoolflow/monitor/watch.hpp"

namespace spoolflow::report {

/// What a watch tells after one recording.
struct MonitoredRun {
  std::string name;  ///< of the recording
  monitor::Ne107 condition;
  std::vector<monitor::Cause> causes;
  std::vector<monitor::Indicator> indicators;
};

/// What it told after one window of events.
struct TrendPoint {
  double windows;  ///< judged so far
  std::vector<monitor::Indicator> indicators;
};

}  // namespace spoolflow::report
