#pragma once
/// A valve of `spoolflow live` for the fuzz targets of its sources.
#include <vector>

#include "addons/live/sources/intake.hpp"
#include "addons/live/valve/valve_at_work.hpp"
#include "tests/fuzz/input_file.hpp"

namespace spoolflow::fuzz {

inline const live::SharedModel& live_model() {
  static const live::SharedModel shared{std::make_shared<const model::Model>(model::read_model(SPOOLFLOW_FUZZ_MODEL)),
                                        "sha"};
  return shared;
}

/// All that waits goes through sensor and monitor. What is kept then must make the same valve again.
inline void work_on_all(live::Intake& intake) {
  live::ValveAtWork valve("v", live_model(), "fuzz", 30);
  std::vector<live::SampleBlock> blocks;
  intake.take(blocks);
  std::uint64_t samples = 0;
  for (const live::SampleBlock& block : blocks) {
    valve.work(block);
    samples += block.samples.size();
  }
  const live::IntakeCounters counted = intake.counters();
  require(samples + counted.dropped == counted.received);
  const live::ValveView view = valve.view();
  require(view.samples == samples);
  (void)valve.raw_csv(-1e9, 1e9);
  const live::ValveCommit kept = valve.take_commit(true);
  require(kept.since_last.samples == static_cast<std::int64_t>(samples));
  live::ValveAtWork other("v", live_model(), "fuzz", 30);
  require(other.restore(kept.state));
  require(other.take_commit(false).state.bytes == kept.state.bytes);
}

}  // namespace spoolflow::fuzz
