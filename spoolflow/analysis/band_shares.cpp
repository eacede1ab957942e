#include "spoolflow/analysis/band_shares.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace spoolflow::analysis {
namespace {

using uncertainty::InputQuantity;
using uncertainty::InputUncertainty;
using uncertainty::SeededNumbers;

constexpr double least_flow_variance = 1e-24;

class BandJudge {
 public:
  explicit BandJudge(const JudgedRun& judged) : judged_(judged) {}

  [[nodiscard]] BandShares shares(const RunResult& result) const;

 private:
  [[nodiscard]] std::size_t trials() const { return judged_.answers.size(); }
  /// Errors [m3/s] with a shape of their own, all combinations: two-point ones and the pressure estimate's.
  [[nodiscard]] std::vector<double> large_errors(std::size_t instant) const;
  /// Share of the errors at an instant between `lower` and `upper`: these, and with each all others together normal;
  /// `u`: standard uncertainty of all [m3/s].
  [[nodiscard]] double share_within(std::size_t instant, double lower, double upper, double u) const;
  /// Whether the reference errs with that input as the calibration does, so that the difference shows nothing of it.
  [[nodiscard]] bool shared_with_reference(InputQuantity quantity) const;
  /// What the reference shows of the errors that it shares with the calibration, trial by trial [m3/s].
  [[nodiscard]] std::vector<double> reference_by_trial(std::size_t instant) const;
  /// Standard uncertainty of estimate less reference; `meter`: that of the reference meter alone [m3/s].
  [[nodiscard]] double difference_uncertainty(std::size_t instant, double combined, double meter) const;
  /// Share of the trials whose band holds what a meter without lag shows of the flow [m3/s].
  [[nodiscard]] double share_of_trials(std::size_t instant, double flow, double meter) const;

  const JudgedRun& judged_;
};

std::vector<double> BandJudge::large_errors(std::size_t instant) const {
  std::vector<double> out{0};
  const auto with_each = [&](const std::vector<double>& errors) {
    std::vector<double> all;
    for (const double before : out)
      for (const double error : errors) all.push_back(before + error);
    out = std::move(all);
  };
  for (std::size_t j = 0; j < judged_.contributions.size(); ++j) {
    const InputUncertainty& input = judged_.inputs[j];
    if (input.distribution == uncertainty::Distribution::two_point) {
      with_each({-judged_.contributions[j][instant], judged_.contributions[j][instant]});
    } else if (input.quantity == InputQuantity::pressure_belief) {
      constexpr int levels = 15;
      std::vector<double> errors;
      for (int k = 0; k < levels; ++k) {
        const double normal = uncertainty::normal_quantile((k + 0.5) / levels);
        errors.push_back(judged_.function.beliefs()[instant].flow_error_m3_per_s(normal));
      }
      with_each(errors);
    }
  }
  return out;
}

double BandJudge::share_within(std::size_t instant, double lower, double upper, double u) const {
  double squares = 0;
  for (std::size_t j = 0; j < judged_.contributions.size(); ++j) {
    const InputUncertainty& input = judged_.inputs[j];
    const bool large =
        input.distribution == uncertainty::Distribution::two_point || input.quantity == InputQuantity::pressure_belief;
    if (large) squares += std::pow(judged_.contributions[j][instant], 2);
  }
  const double others = std::sqrt(std::max(u * u - squares, least_flow_variance));
  const std::vector<double> large = large_errors(instant);
  double share = 0;
  for (const double error : large) {
    share += (uncertainty::normal_share_below((upper + error) / others) -
              uncertainty::normal_share_below((lower + error) / others)) /
             static_cast<double>(large.size());
  }
  return share;
}

bool BandJudge::shared_with_reference(InputQuantity quantity) const {
  return !judged_.scenario.run.other_bench &&
         (quantity == InputQuantity::flow_meter || quantity == InputQuantity::oil_density ||
          quantity == InputQuantity::oil_viscosity);
}

std::vector<double> BandJudge::reference_by_trial(std::size_t instant) const {
  std::vector<double> out(trials());
  for (std::size_t j = 0; j < judged_.contributions.size(); ++j) {
    const InputUncertainty& input = judged_.inputs[j];
    if (!shared_with_reference(input.quantity) || !(input.standard_uncertainty > 0)) continue;
    for (std::size_t trial = 0; trial < trials(); ++trial)
      out[trial] +=
          judged_.drawn[trial][input.quantity] / input.standard_uncertainty * judged_.contributions[j][instant];
  }
  return out;
}

double BandJudge::difference_uncertainty(std::size_t instant, double combined, double meter) const {
  double variance = std::pow(combined, 2) + meter * meter;
  for (std::size_t j = 0; j < judged_.contributions.size(); ++j) {
    if (shared_with_reference(judged_.inputs[j].quantity)) variance -= std::pow(judged_.contributions[j][instant], 2);
  }
  return std::sqrt(std::max(variance, least_flow_variance));
}

double BandJudge::share_of_trials(std::size_t instant, double flow, double meter) const {
  double inside = 0;
  SeededNumbers numbers(judged_.scenario.seed, "reference meter", instant);
  const std::vector<double> shared = reference_by_trial(instant);
  for (std::size_t trial = 0; trial < trials(); ++trial) {
    // What the recording made of the sensor is the truth to a trial, which has a band of its own.
    const double shown =
        flow + shared[trial] + meter * uncertainty::quantile(uncertainty::Distribution::rectangular, numbers.uniform());
    const BandedFlow& answer = judged_.answers[trial];
    inside += answer.lower_m3_per_s[instant] <= shown && shown <= answer.upper_m3_per_s[instant] ? 1 : 0;
  }
  return inside / static_cast<double>(trials());
}

BandShares BandJudge::shares(const RunResult& result) const {
  const RunSettings& run = judged_.scenario.run;
  const std::vector<double> lagged = judged_.function.lagged_m3_per_s(1e-3 * run.reference_lag_ms);
  const double meter_share = run.other_bench ? 0.01 * run.reference_meter_percent / std::numbers::sqrt3 : 0;
  BandShares out;
  out.other_bench = run.other_bench;
  for (std::size_t k = 0; k < judged_.run.instants.size(); ++k) {
    const double reference = result.reference_m3_per_s[k];
    if (!std::isfinite(reference)) continue;
    ++out.instants;
    const double meter = meter_share * std::abs(reference);
    const double u = difference_uncertainty(k, result.combined_m3_per_s[k], meter);
    // The reference shows the flow late: it differs from what it would show of the answer.
    const double error = reference - lagged[k], flow = result.flow_m3_per_s[k];
    const double below = result.lower_m3_per_s[k] - flow, above = result.upper_m3_per_s[k] - flow;
    out.in_band += below <= error && error <= above ? 1 : 0;
    out.in_band_by_budget += share_within(k, below, above, u);
    out.in_band_by_trials += share_of_trials(k, flow, meter);
    out.in_budget_interval += std::abs(error) <= result.coverage_factor * u ? 1 : 0;
  }
  const double n = std::max(1.0, static_cast<double>(out.instants));
  for (double* share : {&out.in_band, &out.in_band_by_budget, &out.in_band_by_trials, &out.in_budget_interval})
    *share /= n;
  return out;
}

}  // namespace

BandShares band_shares(const RunResult& result, const JudgedRun& judged) {
  return BandJudge(judged).shares(result);
}

}  // namespace spoolflow::analysis
