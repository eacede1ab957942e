#pragma once
/// What the forces of one recording say against the model, in words: another unit, a current that reads wrong, a spring
/// that lost force. Sensor and monitor see the same forces; only where the edge is closed no flow explains them.
#include <string>
#include <vector>

#include "spoolflow/monitor/monitor.hpp"

namespace spoolflow::monitor {

/// Odds, to one, from which a recording contradicts its model. Sound recordings of valves beside their own models have
/// 37 at most, a current that reads 5 % off has 2000 and more.
inline constexpr double contradiction_odds = 1000;

/// Judges what was gathered: what the forces look like beside the model's, with its odds and likely causes; empty where
/// they do not contradict it. Friction contradicts no model: the sensor follows it. Recordings without strokes from and
/// to the closed end show nothing.
[[nodiscard]] std::string contradiction(Monitor& watch);

/// Recordings within the calibrated range ask for a higher pressure difference in 8 % of the time at most, of worn
/// valves in 21 %.
inline constexpr double most_beyond_share = 0.25;

/// Adds it as a sentence about the answers to the recording `file`; where there is none, whether the forces mostly ask
/// for a higher pressure difference than is calibrated.
void add_contradiction(Monitor& watch, const std::string& file, std::vector<std::string>& doubts);

}  // namespace spoolflow::monitor
