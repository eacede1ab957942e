#pragma once
/// Indicators from the states, with their names, units and uncertainties.
#include <vector>

#include "spoolflow/monitor/command_response.hpp"
#include "spoolflow/monitor/condition.hpp"
#include "spoolflow/monitor/direction_monitor.hpp"
#include "spoolflow/monitor/dither_health.hpp"
#include "spoolflow/monitor/usage.hpp"

namespace spoolflow::monitor {

/// Of one direction; those of solenoid a have the suffix "_a".
void add_direction(const DirectionReference& reference, const DirectionState& side, bool a,
                   std::vector<Indicator>& out);
/// Where a whole valve rests in its centre.
void add_centre(const std::array<DirectionReference, 2>& reference, const std::array<DirectionState, 2>& sides,
                const CentreRest& rest, std::vector<Indicator>& out);
/// Response to the command.
void add_command_response(const CommandResponse& response, std::vector<Indicator>& out);
/// Dither; `amplitude_A` and `frequency_Hz` of the baseline, 0: not known.
void add_dither_health(const DitherHealth& dither, double amplitude_A, double frequency_Hz,
                       std::vector<Indicator>& out);
/// Counters.
void add_usage(const Usage& usage, double windows, std::vector<Indicator>& out);

}  // namespace spoolflow::monitor
