#pragma once
/// Whether a campaign's recordings can be of one valve, and if not, which usual slip explains them.
#include <vector>

#include "spoolflow/consistency/benches.hpp"
#include "spoolflow/consistency/doubt.hpp"

namespace spoolflow::consistency {

/// The worst first; empty where nothing speaks against them. Each slip that explains what nothing else does is named;
/// nothing is corrected.
[[nodiscard]] std::vector<Doubt> doubts_about(const Benches& benches);

}  // namespace spoolflow::consistency
