#pragma once
/// How units of a virtual valve's series differ, as its campaign states it.
#include <string>

#include "spoolflow/rig/bench/valve_under_test.hpp"

namespace spoolflow::rig {

/// The table [tolerances] of campaign.toml: one standard deviation between units by the valve's manufacturing spread,
/// of a usual series where the valve is the nominal one. What the spread leaves alone has no key. Of one direction.
[[nodiscard]] std::string tolerances_text(const ValveUnderTest& valve);

}  // namespace spoolflow::rig
