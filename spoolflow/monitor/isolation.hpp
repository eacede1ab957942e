#pragma once
/// Which faults explain what was seen: a Bayesian comparison of every set of at most three faults, each with its
/// magnitude free, about a valve that differs from its model by no more than healthy ones do.
///
///     evidence of a set = 1/2 b^T (H + V^-1)^-1 b - 1/2 ln det(1 + V H),   V = healthy^2 + 1 for the magnitudes of the
///     set
///
/// H and b are the information and the pull of the windows. Edges only grow rounder, springs only lose, turns only
/// short: a set whose estimate says otherwise is none. Odds are those of all sets with a fault to all without.
#include "spoolflow/monitor/condition.hpp"
#include "spoolflow/monitor/fault_parameters.hpp"

namespace spoolflow::monitor {

/// The odds of each fault before anything is seen, to one.
inline constexpr double prior_odds = 0.05;
inline constexpr double most_odds = 1e6;
/// The same that the model is wrong in some other way.
inline constexpr double wrong_model_prior_odds = 0.0025;
/// Faults whose magnitudes the forces identify: friction, edge wear, spring, coil, position sensor.
inline constexpr std::size_t isolated_faults = 5;

struct Isolation {
  std::array<double, isolated_faults> odds{};     ///< of each, in the order of Fault
  std::array<bool, isolated_faults> likeliest{};  ///< the set that explains best
  Magnitudes value{};                             ///< by that set
  Magnitudes deviation{};                         ///< one standard deviation of each
  /// That no set explains: each magnitude off by a fault's size and either way, to all sets.
  double unexplained_odds = 0;
  double gain = 0;  ///< ln of how much likelier that set makes what was seen than no fault, prior left out
};

/// `centre`: where the healthy valve lies; `spread`: one standard deviation about it, both in usual_fault.
[[nodiscard]] Isolation isolate(const Evidence& evidence, const Magnitudes& centre, const Magnitudes& spread);

/// One magnitude by itself, all others of a healthy valve.
struct Score {
  double value;      ///< in usual_fault, about the centre
  double deviation;  ///< one standard deviation by the noise of the events; infinite where nothing was identified
};
/// Of a fault: a spring's preload and rate as their usual loss together.
[[nodiscard]] Score score(const Evidence& evidence, const Magnitudes& centre, const Magnitudes& spread, Fault fault);

}  // namespace spoolflow::monitor
