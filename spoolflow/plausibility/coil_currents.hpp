#pragma once
/// A coil's current flows in one direction, and each of a whole valve's coils has its own.
#include <string>

#include "spoolflow/recording/recording.hpp"

namespace spoolflow::plausibility {

/// One signal stands in the columns of both coils (they go together, or are each other's negative), or a coil's current
/// (`current` alone, too) goes to both sides of zero: of both coils, or without its mean where the spool keeps to one
/// side. `means` in blocks. Empty: neither.
[[nodiscard]] std::string signed_coil_currents(const recording::Recording& means);

}  // namespace spoolflow::plausibility
