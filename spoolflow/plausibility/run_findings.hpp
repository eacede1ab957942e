#pragma once
/// Whether a run can be of the valve that a model is of, and if not, which usual recording error explains it.
#include <vector>

#include "spoolflow/plausibility/finding.hpp"
#include "spoolflow/plausibility/known_valve.hpp"
#include "spoolflow/plausibility/run_means.hpp"

namespace spoolflow::plausibility {

/// Reads position, currents, voltages, time and oil temperature, and reference flow and pressure difference where they
/// are there. `file` names the run. Empty where nothing speaks against it.
[[nodiscard]] std::vector<Finding> run_findings(const std::vector<KnownValve>& valve, const RunMeans& run,
                                                const std::filesystem::path& file);

}  // namespace spoolflow::plausibility
