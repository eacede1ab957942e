#pragma once
/// Who we are, to NATS servers: for the sources of this folder alone.
#include "addons/fleet/transport/nats_handles.hpp"

namespace spoolflow::fleet {

/// As the library wants them. Throws LoginError where a file of `access` cannot be read.
[[nodiscard]] Handle<natsOptions> options_of(const NatsAccess& access, const std::string& name);
/// Asks one server after the other until one lets us in; servers that are away are passed over. Throws LoginError where
/// one refuses us.
void check_login(const NatsAccess& access, const std::string& name);

}  // namespace spoolflow::fleet
