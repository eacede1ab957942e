#pragma once
#include <iosfwd>

#include "spoolflow/report/monitor/monitored_run.hpp"
#include "spoolflow/report/text/reader_units.hpp"

namespace spoolflow::report {

/// The condition of a valve as one page: sign of NE 107, causes, indicators, their course from window to window and
/// the indicators after each recording.
void write_monitor_report(std::ostream& out, const model::Model& model, const monitor::Monitor& watch,
                          const std::vector<MonitoredRun>& runs, const std::vector<TrendPoint>& trend,
                          const ReaderUnits& units);

}  // namespace spoolflow::report
