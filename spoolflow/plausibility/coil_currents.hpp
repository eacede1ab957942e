#pragma once
/// Both coils of a whole valve: each has its own current, which flows in one direction.
#include <string>

#include "spoolflow/recording/recording.hpp"

namespace spoolflow::plausibility {

/// One signal stands in the columns of both coils (they go together, or are each other's negative), or a coil's current
/// (`current` alone, too) goes to both sides of zero. `means` in blocks. Empty: neither.
[[nodiscard]] std::string signed_coil_currents(const recording::Recording& means);

}  // namespace spoolflow::plausibility
