#pragma once
/// What --setup prints: the configuration of both servers, with the least rights for each who comes to them.
#include <string>

#include "addons/fleet/settings.hpp"

namespace spoolflow::fleet {

[[nodiscard]] std::string nats_configuration(const FleetSettings& settings);
[[nodiscard]] std::string postgresql_configuration();

}  // namespace spoolflow::fleet
