#pragma once
/// How often the reference meter lies in the sensor's band, and how often budget and trials say that it should.
#include <vector>

#include "spoolflow/analysis/analysed_run.hpp"
#include "spoolflow/analysis/run_function.hpp"
#include "spoolflow/analysis/run_samples.hpp"
#include "spoolflow/analysis/scenario.hpp"

namespace spoolflow::analysis {

/// Contributions [m3/s] of one input at the instants, with their signs.
using Contributions = std::vector<double>;

/// What budget and trials made of a run.
struct JudgedRun {
  const RunFunction& function;
  const RunSamples& run;
  const Scenario& scenario;
  const std::vector<uncertainty::InputUncertainty>& inputs;
  const std::vector<Contributions>& contributions;             ///< of the inputs
  const std::vector<uncertainty::InputErrors<double>>& drawn;  ///< of the trials
  const std::vector<BandedFlow>& answers;                      ///< of the trials
};

/// Over the instants with a reference; of `result` the flow rates, bands, uncertainties and the coverage factor are
/// known.
[[nodiscard]] BandShares band_shares(const RunResult& result, const JudgedRun& judged);

}  // namespace spoolflow::analysis
