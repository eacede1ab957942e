#include "spoolflow/rig/bench/simulate.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "spoolflow/rig/bench/running_bench.hpp"

namespace spoolflow::rig {

Simulation simulate(const ValveUnderTest& valve, const BenchRun& run, std::uint64_t seed,
                    const SimulationOptions& options) {
  RunningBench bench(valve, run, seed);
  GroundTruth truth(run.whole_valve);  // the truth first: see read_scenario
  Simulation out{.recording = {}, .truth = std::move(truth)};
  const std::int64_t end = std::llround(run.duration_s() / electronics_period_s);
  const std::int64_t ticks_per_report = std::max<std::int64_t>(1, end / 200);
  for (std::int64_t tick = 0; tick < end; ++tick) {
    const bool samples = bench.tick(out.recording, options);
    if (samples && options.with_truth) out.truth.add(bench.truth());
    if (options.progress && tick % ticks_per_report == 0) {
      options.progress(static_cast<double>(tick) / static_cast<double>(end));
    }
  }
  return out;
}

}  // namespace spoolflow::rig
