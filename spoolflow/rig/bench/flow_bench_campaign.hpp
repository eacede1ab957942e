#pragma once
/// A campaign on a flow bench: no force sensor, nothing dismounted.
#include "spoolflow/rig/bench/campaign_items.hpp"

namespace spoolflow::rig {

/// Strokes with the pump off, strokes at held pressure differences at each oil temperature, and random moves at work;
/// of a whole valve in both directions, A and B joined or one edge at a time.
void add_flow_bench(CampaignItems& items, const CampaignSettings& settings);

}  // namespace spoolflow::rig
