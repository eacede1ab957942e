#pragma once
/// Runs one planned recording: plant, instruments and electronics together, at the electronics' period.
#include <span>
#include <vector>

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

/// The same of several valves at once, each exactly as alone, in the order given; faster where their plants are alike
/// (rig/plants/plant_group.hpp), most where their runs are equally long. Every valve has a run and a seed of its own.
/// Of the options, `with_truth` and `progress` count.
[[nodiscard]] std::vector<Simulation> simulate_together(std::span<const ValveUnderTest> valves,
                                                        std::span<const BenchRun> runs,
                                                        std::span<const std::uint64_t> seeds,
                                                        const SimulationOptions& options = {});

}  // namespace spoolflow::rig
