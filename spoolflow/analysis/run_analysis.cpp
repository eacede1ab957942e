#include "spoolflow/analysis/run_analysis.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "spoolflow/analysis/band_shares.hpp"
#include "spoolflow/analysis/monte_carlo.hpp"
#include "spoolflow/analysis/run_function.hpp"
#include "spoolflow/parallel/for_each.hpp"
#include "spoolflow/validation/validate.hpp"

namespace spoolflow::analysis {
namespace {

using estimation::Estimator;
using uncertainty::InputErrors;
using uncertainty::InputQuantity;
using uncertainty::InputUncertainty;
using uncertainty::SeededNumbers;

constexpr int noise_runs = 16;
/// Noise comes on top of what the recording holds already: half of it, counted double, lifts the sum to no more than
/// 1.12 times the noise that the sensor was calibrated to.
constexpr double noise_share = 0.5;
/// Samples of all trials together: longer runs get fewer trials.
constexpr double most_samples = 1.5e8;
constexpr std::size_t fewest_trials = 50;

/// Where the oil's temperature was recorded, how far it really was from the map's.
void know_oil_temperature(std::vector<InputUncertainty>& inputs, const model::Model& model, const RunSamples& run) {
  double squares = 0;
  double count = 0;
  for (const std::size_t k : run.instants) {
    const double away_K = run.samples[k].oil_temperature_K - uncertainty::map_temperature_K(model);
    if (!std::isfinite(away_K)) continue;
    squares += away_K * away_K;
    count += 1;
  }
  if (count == 0) return;
  for (InputUncertainty& input : inputs) {
    if (input.quantity != InputQuantity::oil_temperature) continue;
    input.standard_uncertainty = std::sqrt(squares / count);
    input.distribution = uncertainty::Distribution::normal;
    input.source = "recording: root mean square of the oil about the map's temperature";
  }
}

class RunBudget {
 public:
  RunBudget(const model::Model& model, Estimator estimator, const RunSamples& run, const Scenario& scenario)
      : function_(model, estimator, run),
        inputs_(uncertainty::inputs_of(model, estimator, instrument_figures(scenario.instruments))),
        scenario_(scenario),
        run_(run) {
    if (estimator == Estimator::condensed) know_oil_temperature(inputs_.uncertainties, model, run);
    for (InputUncertainty& input : inputs_.uncertainties) {
      // Along a run it counts in units of what the filter claims at each instant.
      if (input.quantity == InputQuantity::pressure_belief) input.standard_uncertainty = 1;
    }
    trials_ = std::max(fewest_trials,
                       static_cast<std::size_t>(std::min(scenario.monte_carlo.trials_along_run,
                                                         most_samples / static_cast<double>(run.samples.size()))));
  }

  [[nodiscard]] std::size_t pieces() const { return inputs_.uncertainties.size() + trials_; }
  /// Piece by piece, in any order and from any thread.
  void prepare() {
    contributions_.resize(inputs_.uncertainties.size());
    drawn_.resize(trials_);
    answers_.resize(trials_);
    if (function_.estimator() == Estimator::condensed) slopes_ = function_.slopes();
    budget_.correlations = inputs_.correlations;
    for (const InputUncertainty& input : inputs_.uncertainties) budget_.lines.push_back({input});
  }
  void work(std::size_t piece) {
    if (piece < contributions_.size()) {
      contributions_[piece] = contributions(inputs_.uncertainties[piece]);
    } else {
      try_out(piece - contributions_.size());
    }
  }
  [[nodiscard]] RunResult result();

 private:
  [[nodiscard]] Contributions contributions(const InputUncertainty& input) const;
  void try_out(std::size_t trial);
  void combine_instants(RunResult& out);
  void take_trials(RunResult& out) const;

  RunFunction function_;
  uncertainty::Inputs inputs_;
  const Scenario& scenario_;
  const RunSamples& run_;
  std::size_t trials_;
  uncertainty::Budget budget_;  ///< the lines from which trials are drawn
  std::vector<uncertainty::PerQuantity<double>> slopes_;
  std::vector<Contributions> contributions_;
  std::vector<InputErrors<double>> drawn_;  ///< of the trials
  std::vector<BandedFlow> answers_;         ///< of the trials
};

Contributions RunBudget::contributions(const InputUncertainty& input) const {
  const double u = input.standard_uncertainty;
  Contributions out(run_.instants.size());
  SeededNumbers none(0, "");
  InputErrors<double> error;
  if (function_.estimator() == Estimator::condensed) {
    for (std::size_t k = 0; k < out.size(); ++k) out[k] = u * slopes_[k][input.quantity];
  } else if (input.quantity == InputQuantity::pressure_belief) {
    out = function_.belief_m3_per_s();
  } else if (is_noise(input.quantity)) {
    error[input.quantity] = noise_share * u;
    for (int run = 0; run < noise_runs; ++run) {
      SeededNumbers numbers(1, uncertainty::about(input.quantity).name, static_cast<std::uint64_t>(run));
      const std::vector<double> noisy = function_(error, numbers).flow_m3_per_s;
      for (std::size_t k = 0; k < out.size(); ++k)
        out[k] += std::pow(noisy[k] - function_.undisturbed().flow_m3_per_s[k], 2) / noise_runs;
    }
    for (double& value : out) value = std::sqrt(value) / noise_share;
  } else {
    error[input.quantity] = u;
    const std::vector<double> above = function_(error, none).flow_m3_per_s;
    error[input.quantity] = -u;
    const std::vector<double> below = function_(error, none).flow_m3_per_s;
    for (std::size_t k = 0; k < out.size(); ++k) out[k] = 0.5 * (above[k] - below[k]);
  }
  return out;
}

void RunBudget::try_out(std::size_t trial) {
  SeededNumbers numbers(scenario_.seed, "trial along a run", trial);
  InputErrors<double> error = drawn_[trial] = drawn_errors(budget_, numbers);
  for (const InputUncertainty& input : inputs_.uncertainties) {
    if (is_noise(input.quantity)) error[input.quantity] = noise_share * input.standard_uncertainty;
  }
  answers_[trial] = function_(error, numbers);
}

void RunBudget::combine_instants(RunResult& out) {
  std::vector<uncertainty::BudgetLine> mean = budget_.lines;
  std::vector<double> squares(mean.size());
  for (std::size_t k = 0; k < run_.instants.size(); ++k) {
    std::vector<uncertainty::BudgetLine> lines = budget_.lines;
    for (std::size_t j = 0; j < lines.size(); ++j) {
      lines[j].contribution_m3_per_s = contributions_[j][k];
      lines[j].degrees_of_freedom = lines[j].input.degrees_of_freedom;
      squares[j] += lines[j].contribution_m3_per_s * lines[j].contribution_m3_per_s;
    }
    const uncertainty::Budget budget = uncertainty::combine(std::move(lines), inputs_.correlations);
    out.combined_m3_per_s.push_back(budget.combined_m3_per_s);
    for (std::size_t j = 0; j < mean.size(); ++j)
      mean[j].share += budget.lines[j].share * budget.combined_m3_per_s * budget.combined_m3_per_s;
  }
  double variance = 0;
  for (const uncertainty::BudgetLine& line : mean) variance += line.share;
  const auto n = static_cast<double>(run_.instants.size());
  for (std::size_t j = 0; j < mean.size(); ++j) {
    mean[j].share = variance > 0 ? mean[j].share / variance : 0;
    mean[j].contribution_m3_per_s = std::sqrt(squares[j] / n);
    mean[j].degrees_of_freedom = mean[j].input.degrees_of_freedom;
    out.lines.push_back({mean[j].input, mean[j].contribution_m3_per_s, mean[j].share});
  }
  out.coverage_factor =
      uncertainty::coverage_factor_95(uncertainty::effective_degrees_of_freedom(mean, inputs_.correlations));
}

void RunBudget::take_trials(RunResult& out) const {
  const auto n = static_cast<double>(trials_);
  double of_trials = 0;
  double of_budget = 0;
  for (std::size_t k = 0; k < run_.instants.size(); ++k) {
    double mean = 0;
    for (const BandedFlow& answer : answers_) mean += answer.flow_m3_per_s[k] / n;
    double squares = 0;
    for (const BandedFlow& answer : answers_) squares += std::pow(answer.flow_m3_per_s[k] - mean, 2);
    out.deviation_m3_per_s.push_back(std::sqrt(squares / (n - 1)));
    of_trials += squares / (n - 1);
    of_budget += out.combined_m3_per_s[k] * out.combined_m3_per_s[k];
  }
  out.deviation_ratio = of_budget > 0 ? std::sqrt(of_trials / of_budget) : std::nan("");
}

RunResult RunBudget::result() {
  RunResult out;
  out.estimator = function_.estimator();
  out.trials = trials_;
  for (const std::size_t k : run_.instants) {
    out.time_s.push_back(run_.samples[k].time_s);
    if (!run_.reference_m3_per_s.empty()) out.reference_m3_per_s.push_back(run_.reference_m3_per_s[k]);
  }
  out.flow_m3_per_s = function_.undisturbed().flow_m3_per_s;
  out.lower_m3_per_s = function_.undisturbed().lower_m3_per_s;
  out.upper_m3_per_s = function_.undisturbed().upper_m3_per_s;
  combine_instants(out);
  take_trials(out);
  if (!out.reference_m3_per_s.empty()) {
    const BandShares shares =
        band_shares(out, {function_, run_, scenario_, inputs_.uncertainties, contributions_, drawn_, answers_});
    if (shares.instants > 0) out.shares = shares;
  }
  return out;
}

}  // namespace

RunAnalysis analyse_run(const model::Model& model, const RunSamples& run, const Scenario& scenario, unsigned workers,
                        const std::function<void(double)>& progress) {
  RunAnalysis out{run.name, run.samples.size(), {}};
  const std::vector<Estimator> estimators = estimation::all_estimators(model);
  for (const Estimator estimator : estimators) {
    RunBudget budget(model, estimator, run, scenario);
    budget.prepare();
    std::mutex mutex;  // guards progress
    double done = 0;
    parallel::for_each(budget.pieces(), workers, [&](std::size_t piece) {
      budget.work(piece);
      const std::lock_guard lock(mutex);
      done += 1 / static_cast<double>(budget.pieces());
      progress((static_cast<double>(out.results.size()) + done) / static_cast<double>(estimators.size()));
    });
    out.results.push_back(budget.result());
  }
  return out;
}

}  // namespace spoolflow::analysis
