#pragma once
/// The campaign of a whole valve: the bench tests of each direction, `*_b.csv` and `*_a.csv`, then runs of the valve at
/// work through the centre, `both_*.csv`, the first of which is for calibration.
#include "spoolflow/rig/bench/campaign_items.hpp"

namespace spoolflow::rig {

void add_whole_calibration(CampaignItems& items, const CampaignSettings& settings);

/// Ramps at several pressures, random duty, warming oil, steps of the pressure, a sine sweep, fast motion; the same
/// duty with dither, an orifice with dither, a cylinder under loads that help and hinder it (both_overrunning), and
/// under loads beyond what the supply holds, so that oil flows back (both_regenerative).
void add_whole_validation(CampaignItems& items, const CampaignSettings& settings);

}  // namespace spoolflow::rig
