#pragma once
#include <iosfwd>
#include <string>
#include <vector>

#include "spoolflow/monitor/watch.hpp"

namespace spoolflow::report {

/// What a watch tells after one recording.
struct MonitoredRun {
  std::string name;  ///< of the recording
  std::string ne107;
  std::vector<monitor::Indicator> indicators;
};

/// Condition, causes and indicators of a valve as JSON, with the baseline learnt; the keys are described in
/// docs/monitoring.md. A figure that is not known is null.
void write_monitor_json(std::ostream& out, const model::Model& model, const monitor::Watch& watch,
                        const std::vector<MonitoredRun>& runs);

}  // namespace spoolflow::report
