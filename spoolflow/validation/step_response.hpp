#pragma once
/// How fast the estimate follows sudden changes of the flow, beside the reference meter.
#include <cstddef>
#include <optional>
#include <vector>

#include "spoolflow/estimation/estimator.hpp"
#include "spoolflow/validation/run_samples.hpp"

namespace spoolflow::validation {

/// One estimator's answer to a run's steps; medians over the steps that it followed by at least half.
struct StepAnswer {
  estimation::Estimator estimator;
  std::size_t followed;
  double delay_s;             ///< at half of the step, against the reference meter; negative: earlier than the meter
  double rise_s;              ///< from 10 to 90 % of its own step
  double overshoot;           ///< beyond its own end, as a share of its step
  std::vector<float> course;  ///< mean of all followed steps, from 0 before to 1 after, at `StepResponse::time_s`
};

struct StepResponse {
  std::size_t steps;
  double reference_rise_s;     ///< median, 10 to 90 %
  std::vector<double> time_s;  ///< about the instant at which the reference passes half of the step
  std::vector<float> reference_course;
  std::vector<StepAnswer> answers;
};

/// A step: the reference changes by more than a tenth of full scale within 0.2 s, and is steady for 0.2 s before and
/// for 0.4 s after. Nothing where the run has none.
[[nodiscard]] std::optional<StepResponse> step_response(const RunSamples& run, double full_scale_m3_per_s);

}  // namespace spoolflow::validation
