#pragma once
#include <string>
#include <vector>

#include "spoolflow/monitor/monitor.hpp"

namespace spoolflow::report {

/// The monitor's result after one recording.
struct MonitoredRun {
  std::string name;  ///< of the recording
  monitor::Ne107 condition;
  std::vector<monitor::Cause> causes;
  std::vector<monitor::Indicator> indicators;
};

/// How far raised indicators widened the band (monitor::widened); sums over the samples in which they did.
struct DoubtFigures {
  double samples = 0;  ///< all
  double doubted = 0;
  double sensor_m3_per_s = 0;   ///< widths of the sensor's own band
  double widened_m3_per_s = 0;  ///< widened
};

/// The same after one window of events.
struct TrendPoint {
  double windows;  ///< judged so far
  std::vector<monitor::Indicator> indicators;
};

}  // namespace spoolflow::report
