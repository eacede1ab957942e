#pragma once
/// Recordings and ground truth as CSV: `<channel>_<unit>` headers, the units and decimals of a real recorder.
#include <iosfwd>

#include "spoolflow/rig/bench/bench_run.hpp"
#include "spoolflow/rig/bench/simulate.hpp"

namespace spoolflow::rig {

/// The run's channels in their order. The same recording gives the same bytes.
void write_recording(std::ostream& stream, const recording::Recording& recording, const BenchRun& run);

/// The truth's columns; time stamps as written by write_recording.
void write_truth(std::ostream& stream, const GroundTruth& truth);

}  // namespace spoolflow::rig
