#pragma once
/// Propagation of distributions (JCGM 101:2008) through the sensor's own code, beside the budget.
#include <cstdint>

#include "spoolflow/uncertainty/point_function.hpp"

namespace spoolflow::analysis {

struct MonteCarloSettings {
  std::size_t trials = 10000;         ///< of one block; all, unless adaptive
  bool adaptive = false;              ///< blocks until the figures are stable (7.9)
  std::size_t most_trials = 1000000;  ///< of an adaptive run
  int digits = 1;                     ///< significant digits of the standard uncertainty that are to be right
};

/// What the trials gave [m3/s].
struct TrialFigures {
  std::size_t trials = 0;
  double mean = 0, standard_deviation = 0;
  double lower = 0, upper = 0;                    ///< 95 %, as much probability below as above
  double shortest_lower = 0, shortest_upper = 0;  ///< the shortest interval that holds 95 % (JCGM 101, 5.3.4)
  double standard_error_of_deviation = 0;         ///< what another seed would change of the standard deviation
};

/// Whether the budget may stand for the distributions (JCGM 101, clause 8).
struct Comparison {
  double deviation_ratio = 0;                         ///< Monte Carlo's standard deviation over the budget's
  double lower_difference = 0, upper_difference = 0;  ///< of the intervals' ends [m3/s]
  double tolerance = 0;    ///< half a unit of the last significant digit of the standard uncertainty [m3/s]
  bool validated = false;  ///< both differences are within it
};

struct MonteCarlo {
  TrialFigures figures;
  Comparison comparison;
};

/// The 95 % interval to be stated [m3/s].
struct StatedInterval {
  double lower = 0, upper = 0;
  bool by_budget = false;  ///< else by the trials
};

/// The budget's where the trials validate it, else theirs (JCGM 101, 8.2). `undisturbed` as in `compared`.
[[nodiscard]] StatedInterval stated_interval(const uncertainty::Budget& budget, double undisturbed,
                                             const MonteCarlo& check);

/// Errors of all inputs, drawn from their distributions with their correlations.
[[nodiscard]] uncertainty::InputErrors<double> drawn_errors(const uncertainty::Budget& budget,
                                                            uncertainty::SeededNumbers& numbers);

/// Figures of a set of outputs; sorts it.
[[nodiscard]] TrialFigures figures_of(std::vector<double>& outputs);

/// Half a unit of the `digits`-th significant digit (JCGM 101, 7.9.2).
[[nodiscard]] double numerical_tolerance(double standard_uncertainty, int digits);

/// `undisturbed`: the flow rate with no errors, about which the budget's interval lies.
[[nodiscard]] Comparison compared(const uncertainty::Budget& budget, double undisturbed, const TrialFigures& figures,
                                  int digits);

[[nodiscard]] MonteCarlo monte_carlo(const uncertainty::PointFunction& function, const uncertainty::Budget& budget,
                                     const MonteCarloSettings& settings, std::uint64_t seed);

}  // namespace spoolflow::analysis
