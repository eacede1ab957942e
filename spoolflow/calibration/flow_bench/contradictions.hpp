#pragma once
/// What cannot be of recordings on a flow bench: signs, units, ports and columns that contradict each other.
#include <string>
#include <vector>

#include "spoolflow/calibration/flow_bench/flow_bench_recordings.hpp"

namespace spoolflow::calibration {

/// A sentence each with file, channel, value, what is allowed and what is likely the cause; empty where all is well.
/// Needs the valve's rated flow [m3/s] and stroke [m].
struct ValveFigures {
  double rated_flow_m3_per_s;
  double stroke_m;
};
[[nodiscard]] std::vector<std::string> contradictions_of(const FlowBenchRecordings& recordings,
                                                         const ValveFigures& valve);

}  // namespace spoolflow::calibration
