#pragma once
/// What is told of the states: indicators with their names, units and uncertainties.
#include <vector>

#include "spoolflow/monitor/command_response.hpp"
#include "spoolflow/monitor/condition.hpp"
#include "spoolflow/monitor/dither_health.hpp"
#include "spoolflow/monitor/side.hpp"
#include "spoolflow/monitor/usage.hpp"

namespace spoolflow::monitor {

/// Of one direction; those of solenoid a have the suffix "_a".
void tell_side(const SideReference& reference, const SideState& side, bool a, std::vector<Indicator>& out);
/// Where a whole valve rests in its centre.
void tell_centre(const std::array<SideReference, 2>& reference, const std::array<SideState, 2>& sides,
                 const CentreRest& rest, std::vector<Indicator>& out);
/// Response to the command.
void tell_command(const CommandResponse& response, std::vector<Indicator>& out);
/// Dither; `amplitude_A` and `frequency_Hz` of the baseline, 0: not known.
void tell_dither(const DitherHealth& dither, double amplitude_A, double frequency_Hz, std::vector<Indicator>& out);
/// Counters.
void tell_usage(const Usage& usage, double windows, std::vector<Indicator>& out);

}  // namespace spoolflow::monitor
