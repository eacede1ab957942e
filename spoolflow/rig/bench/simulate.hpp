#pragma once
/// Runs one planned recording: plant, instruments and electronics together, at the electronics' period.
#include "spoolflow/recording/recording.hpp"
#include "spoolflow/rig/bench/ground_truth.hpp"
#include "spoolflow/rig/bench/running_bench.hpp"

namespace spoolflow::rig {

struct Simulation {
  recording::Recording recording;  ///< what the instruments show; the run's channels only
  GroundTruth truth;               ///< empty unless asked for
};

/// `valve` as it is (spread and wear go in by as_built); all noise and faults follow from `seed`. Current and voltage
/// are means over the sample period that ends at the time stamp, everything else is read at the time stamp.
/// Throws std::runtime_error, naming time and quantity, should the plant leave the finite numbers.
[[nodiscard]] Simulation simulate(const ValveUnderTest& valve, const BenchRun& run, std::uint64_t seed,
                                  const SimulationOptions& options = {});

}  // namespace spoolflow::rig
