#pragma once
/// Whether a run can be of the valve that a model is of, and if not, which usual slip explains it.
#include <vector>

#include "spoolflow/consistency/doubt.hpp"
#include "spoolflow/consistency/known_valve.hpp"
#include "spoolflow/consistency/run_means.hpp"

namespace spoolflow::consistency {

/// Reads position, currents, voltages, time and oil temperature, and reference flow and pressure difference where they
/// are there. `file` names the run. Empty where nothing speaks against it.
[[nodiscard]] std::vector<Doubt> doubts_about(const std::vector<KnownValve>& valve, const RunMeans& run,
                                              const std::filesystem::path& file);

}  // namespace spoolflow::consistency
