#pragma once
/// The virtual valve's settings and samples in the units of the page.
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "addons/playground/requests/virtual_valve.hpp"

namespace spoolflow::playground {

/// What is not said is as in ValveSettings. Throws nlohmann::json::exception.
[[nodiscard]] ValveSettings settings_of(const nlohmann::json& asked);

/// Columns of every fifth sample, flow in L/min, position in mm, current in A; the names of the last one's status.
[[nodiscard]] nlohmann::json json_of(const std::vector<PlayedSample>& samples);

}  // namespace spoolflow::playground
