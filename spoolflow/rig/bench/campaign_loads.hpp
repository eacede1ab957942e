#pragma once
/// The valve of a campaign under dither, or under a load sized for its rating.
#include "spoolflow/rig/bench/campaign_items.hpp"

namespace spoolflow::rig {

/// As the campaign dithers it, where its electronics have no dither of their own.
[[nodiscard]] ValveUnderTest dithered(ValveUnderTest valve, const CampaignSettings& settings);

/// An orifice or motor that a valve of this rating can feed: fully open, a quarter of the supply pressure [bar] is left
/// over its edge, or over both edges of a whole valve. What comes back from the load of a valve of one direction goes
/// straight to tank: its bench has measured the edge P to B alone.
[[nodiscard]] ValveUnderTest loaded(ValveUnderTest valve, LoadKind kind, double supply_bar);

/// The valve's own cylinder, or one with equal areas whose stroke takes rated flow for 75 s.
[[nodiscard]] ValveUnderTest with_cylinder(ValveUnderTest valve);

}  // namespace spoolflow::rig
