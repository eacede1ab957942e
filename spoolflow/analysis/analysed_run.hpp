#pragma once
/// What the budget and its trials show of one estimator along a recording.
#include <cstddef>
#include <optional>
#include <vector>

#include "spoolflow/estimation/estimator.hpp"
#include "spoolflow/uncertainty/input_quantity.hpp"

namespace spoolflow::analysis {

/// How many samples lie in a band, and how many should.
struct BandShares {
  std::size_t instants = 0;       ///< with a reference
  double in_band = 0;             ///< of the sensor's own band
  double in_band_by_budget = 0;   ///< what the budget predicts
  double in_band_by_trials = 0;   ///< what Monte Carlo predicts
  bool other_bench = false;       ///< the errors of oil and flow meter count in both predictions
  double in_budget_interval = 0;  ///< in the budget's expanded interval, 95 % of which are promised
};

/// One input along the run.
struct RunLine {
  uncertainty::InputUncertainty input;
  double rms_contribution_m3_per_s = 0;
  double share = 0;  ///< of the run's mean variance, correlations included
};

/// One estimator along a run; one entry an instant.
struct RunResult {
  estimation::Estimator estimator{};
  std::size_t trials = 0;
  std::vector<double> time_s, flow_m3_per_s, lower_m3_per_s, upper_m3_per_s;
  std::vector<double> reference_m3_per_s;  ///< empty, or NaN where missing
  std::vector<double> combined_m3_per_s;   ///< the budget's standard uncertainty
  std::vector<double> deviation_m3_per_s;  ///< standard deviation of the trials
  std::vector<RunLine> lines;
  double coverage_factor = 0;  ///< of the effective degrees of freedom of the run's mean variance
  double deviation_ratio = 0;  ///< root mean square of the trials' deviation over the budget's
  std::optional<BandShares> shares;
};

}  // namespace spoolflow::analysis
