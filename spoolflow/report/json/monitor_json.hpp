#pragma once
#include <iosfwd>
#include <vector>

#include "spoolflow/report/monitor/monitored_run.hpp"

namespace spoolflow::report {

/// Condition, causes and indicators of a valve as JSON, with the baseline learnt; the keys are described in
/// docs/monitoring.md. A figure that is not known is null.
void write_monitor_json(std::ostream& out, const model::Model& model, const monitor::Monitor& watch,
                        const std::vector<MonitoredRun>& runs, const DoubtFigures& doubt);

}  // namespace spoolflow::report
