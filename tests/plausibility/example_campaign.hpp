#pragma once
/// The campaign in examples/valve_a, as the tests hold a rig's valve.
#include "spoolflow/recording/campaign.hpp"
#include "spoolflow/recording/reader.hpp"
#include "tests/plausibility/rig_benches.hpp"

namespace spoolflow::plausibility {

inline RigBenches example_benches() {
  const recording::Campaign campaign = recording::read_campaign(SPOOLFLOW_EXAMPLES "/valve_a/campaign.toml");
  RigBenches out{campaign.valve.stroke_m, campaign.valve.rated_flow_m3_per_s, {}};
  for (const recording::CampaignRecording& entry : campaign.recordings) {
    recording::Recording& kept = out.recordings[entry.file.filename().string()];
    kept = recording::read_recording(entry.file, {});
    kept.file = entry.file.filename();
  }
  return out;
}

/// Made once.
inline const RigBenches& example() {
  static const RigBenches valve = example_benches();
  return valve;
}
inline const recording::Recording& ramp() {
  return example().recordings.at("ramp_60bar.h5");
}
inline const recording::Recording& duty_cycle() {
  static const recording::Recording run = recording::read_recording(SPOOLFLOW_EXAMPLES "/valve_a/duty_cycle_1.h5", {});
  return run;
}

}  // namespace spoolflow::plausibility
