#pragma once
/// Whether a campaign's recordings can be of one valve, and if not, which usual recording error explains them.
#include <vector>

#include "spoolflow/plausibility/benches.hpp"
#include "spoolflow/plausibility/finding.hpp"

namespace spoolflow::plausibility {

/// The worst first; empty where nothing speaks against them. Each recording error that explains what nothing else does
/// is named; nothing is corrected.
[[nodiscard]] std::vector<Finding> campaign_findings(const Benches& benches);

}  // namespace spoolflow::plausibility
