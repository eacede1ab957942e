#include "spoolflow/analysis/monte_carlo.hpp"

#include <algorithm>
#include <cmath>

namespace spoolflow::analysis {
namespace {

using uncertainty::InputErrors;
using uncertainty::InputQuantity;
using uncertainty::SeededNumbers;

/// Whether blocks agree well enough among each other that their mean is right to the tolerance (JCGM 101, 7.9.4).
bool stable(const std::vector<TrialFigures>& blocks, int digits) {
  if (blocks.size() < 2) return false;
  const auto n = static_cast<double>(blocks.size());
  double deviation = 0;
  for (const TrialFigures& block : blocks) deviation += block.standard_deviation / n;
  const double tolerance = numerical_tolerance(deviation, digits);
  for (double TrialFigures::*figure :
       {&TrialFigures::mean, &TrialFigures::standard_deviation, &TrialFigures::lower, &TrialFigures::upper}) {
    double mean = 0;
    for (const TrialFigures& block : blocks) mean += block.*figure / n;
    double squares = 0;
    for (const TrialFigures& block : blocks) squares += std::pow(block.*figure - mean, 2);
    if (2 * std::sqrt(squares / (n * (n - 1))) > tolerance) return false;
  }
  return true;
}

}  // namespace

InputErrors<double> drawn_errors(const uncertainty::Budget& budget, SeededNumbers& numbers) {
  InputErrors<double> error;
  for (const uncertainty::BudgetLine& line : budget.lines) {
    error[line.input.quantity] = uncertainty::quantile(line.input.distribution, numbers.uniform());
  }
  for (const uncertainty::Correlation& c : budget.correlations) {
    error[c.other] = c.coefficient * error[c.one] + std::sqrt(1 - c.coefficient * c.coefficient) * error[c.other];
  }
  for (const uncertainty::BudgetLine& line : budget.lines) {
    error[line.input.quantity] *= line.input.standard_uncertainty;
  }
  return error;
}

TrialFigures figures_of(std::vector<double>& outputs) {
  std::sort(outputs.begin(), outputs.end());
  TrialFigures out;
  out.trials = outputs.size();
  const auto n = static_cast<double>(outputs.size());
  for (const double y : outputs) out.mean += y / n;
  double fourth = 0;
  double squares = 0;
  for (const double y : outputs) {
    const double square = (y - out.mean) * (y - out.mean);
    squares += square;
    fourth += square * square;
  }
  out.standard_deviation = std::sqrt(squares / (n - 1));
  const double variance = squares / n;
  if (variance > 0) {
    out.standard_error_of_deviation =
        0.5 * std::sqrt(std::max(0.0, fourth / n - variance * variance) / n) / std::sqrt(variance);
  }
  const auto at = [&](double share) { return outputs[static_cast<std::size_t>(std::lround(share * (n - 1)))]; };
  out.lower = at(0.025);
  out.upper = at(0.975);
  const auto held = static_cast<std::size_t>(std::lround(0.95 * n));
  out.shortest_lower = outputs.front();
  out.shortest_upper = outputs.back();
  for (std::size_t k = 0; k + held < outputs.size(); ++k) {
    if (outputs[k + held] - outputs[k] >= out.shortest_upper - out.shortest_lower) continue;
    out.shortest_lower = outputs[k];
    out.shortest_upper = outputs[k + held];
  }
  return out;
}

StatedInterval stated_interval(const uncertainty::Budget& budget, double undisturbed, const MonteCarlo& check) {
  if (!check.comparison.validated) return {check.figures.lower, check.figures.upper, false};
  return {undisturbed - budget.expanded_m3_per_s, undisturbed + budget.expanded_m3_per_s, true};
}

double numerical_tolerance(double standard_uncertainty, int digits) {
  if (!(standard_uncertainty > 0)) return 0;
  return 0.5 * std::pow(10.0, std::floor(std::log10(standard_uncertainty)) - (digits - 1));
}

Comparison compared(const uncertainty::Budget& budget, double undisturbed, const TrialFigures& figures, int digits) {
  // In L/min, the unit in which the uncertainty is stated: significant digits depend on it no more than on any other.
  Comparison out;
  out.deviation_ratio =
      budget.combined_m3_per_s > 0 ? figures.standard_deviation / budget.combined_m3_per_s : std::nan("");
  out.lower_difference = std::abs(undisturbed - budget.expanded_m3_per_s - figures.lower);
  out.upper_difference = std::abs(undisturbed + budget.expanded_m3_per_s - figures.upper);
  constexpr double L_min = 60000;
  out.tolerance = numerical_tolerance(budget.combined_m3_per_s * L_min, digits) / L_min;
  out.validated = out.lower_difference <= out.tolerance && out.upper_difference <= out.tolerance;
  return out;
}

MonteCarlo monte_carlo(const uncertainty::PointFunction& function, const uncertainty::Budget& budget,
                       const MonteCarloSettings& settings, std::uint64_t seed) {
  const bool remembers = function.estimator() == estimation::Estimator::observer;
  std::vector<double> outputs;
  std::vector<TrialFigures> blocks;
  const auto trial = [&](std::size_t number) {
    SeededNumbers numbers(seed, "trial of the budget", number);
    InputErrors<double> error = drawn_errors(budget, numbers);
    for (const uncertainty::BudgetLine& line : budget.lines) {
      if (remembers && is_noise(line.input.quantity)) error[line.input.quantity] = line.input.standard_uncertainty;
    }
    return function(error, numbers);
  };
  do {
    std::vector<double> block;
    for (std::size_t k = 0; k < settings.trials; ++k) block.push_back(trial(outputs.size() + k));
    outputs.insert(outputs.end(), block.begin(), block.end());
    blocks.push_back(figures_of(block));
  } while (settings.adaptive && outputs.size() + settings.trials <= settings.most_trials &&
           !stable(blocks, settings.digits));
  SeededNumbers none(0, "");
  MonteCarlo out{figures_of(outputs), {}};
  out.comparison = compared(budget, function({}, none), out.figures, settings.digits);
  return out;
}

}  // namespace spoolflow::analysis
