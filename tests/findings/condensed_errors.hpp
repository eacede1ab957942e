#pragma once
/// The condensed sensor, calibrated on the rig's own campaign of the default valve, on its operating runs (paper
/// section 4, Figs 9 and 10).
#include <filesystem>

#include "spoolflow/validation/run_samples.hpp"
#include "tests/findings/finding.hpp"

namespace spoolflow::findings {

struct CondensedRuns {
  /// 60 bar, 5 %/s, each with other noise: when a sticking spool breaks away is a matter of chance, so figures on one
  /// run vary. The first is the campaign's own.
  std::vector<validation::RunSamples> ramp;
  validation::RunSamples ramps;  ///< 30 to 70 bar
};

/// Simulates, calibrates and validates; its files go into `folder`, which exists.
[[nodiscard]] CondensedRuns condensed_runs(const std::filesystem::path& folder);
[[nodiscard]] std::vector<Finding> condensed_findings(const CondensedRuns& runs);

}  // namespace spoolflow::findings
