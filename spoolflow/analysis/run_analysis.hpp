#pragma once
/// The budget along a recording, held against Monte Carlo and, where there is one, against the reference meter.
#include <functional>
#include <string>
#include <vector>

#include "spoolflow/analysis/analysed_run.hpp"
#include "spoolflow/analysis/run_samples.hpp"
#include "spoolflow/analysis/scenario.hpp"
#include "spoolflow/model/model.hpp"

namespace spoolflow::analysis {

struct RunAnalysis {
  std::string recording;
  std::size_t samples = 0;
  std::vector<RunResult> results;
};

[[nodiscard]] RunAnalysis analyse_run(const model::Model& model, const RunSamples& run, const Scenario& scenario,
                                      unsigned workers, const std::function<void(double)>& progress);

}  // namespace spoolflow::analysis
