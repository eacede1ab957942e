#include "spoolflow/monitor/isolation.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "spoolflow/monitor/dense.hpp"

namespace spoolflow::monitor {
namespace {

constexpr unsigned sets = 1U << isolated_faults;
constexpr int largest_set = 3;

constexpr bool has(unsigned set, Fault fault) {
  return (set >> static_cast<unsigned>(fault) & 1U) != 0;
}

/// The magnitudes of each fault.
constexpr bool belongs(std::size_t fault, std::size_t magnitude) {
  constexpr std::array<std::size_t, magnitudes> fault_of{0, 1, 2, 2, 3, 4};
  return fault_of[magnitude] == fault;
}

struct Explanation {
  double evidence = -1e300;
  Magnitudes value{};
  Magnitudes deviation{};
};

/// The pull about the centre.
Magnitudes pull_about(const Evidence& evidence, const Magnitudes& centre) {
  Magnitudes out = evidence.pull;
  for (std::size_t r = 0; r < magnitudes; ++r) {
    for (std::size_t c = 0; c < magnitudes; ++c) out[r] -= evidence.information[r * magnitudes + c] * centre[c];
  }
  return out;
}

/// What is known before: variances and, of preload and rate, their covariance.
struct Prior {
  Magnitudes variance{};
  double spring_covariance = 0;
};

/// A spring loses preload and rate together: one loss for both, and half as much apart.
constexpr double rate_beside_preload = 0.8;
constexpr double spring_apart = 0.5;

Prior prior_of(unsigned set, const Magnitudes& spread) {
  Prior out;
  for (std::size_t k = 0; k < magnitudes; ++k) {
    out.variance[k] = spread[k] * spread[k];
    for (std::size_t f = 0; f < isolated_faults; ++f) {
      if ((set >> f & 1U) == 0 || !belongs(f, k)) continue;
      const bool rate = k == index(Magnitude::rate_loss);
      const bool spring = f == static_cast<std::size_t>(Fault::spring);
      const double together = rate ? rate_beside_preload : 1.0;
      out.variance[k] += spring ? together * together + spring_apart * spring_apart : 1.0;
      if (rate) out.spring_covariance = rate_beside_preload;
    }
  }
  return out;
}

Explanation explain_by(const Evidence& evidence, const Magnitudes& pull, const Prior& prior) {
  Explanation out;
  MagnitudeMatrix factor = evidence.information;
  double scale = 0;  // ln det(1 + V H) = ln det(H + V^-1) + ln det V
  constexpr std::size_t preload = index(Magnitude::preload_loss);
  constexpr std::size_t rate = index(Magnitude::rate_loss);
  for (std::size_t k = 0; k < magnitudes; ++k) {
    if (k == preload || k == rate) continue;
    factor[k * magnitudes + k] += 1 / prior.variance[k];
    scale += std::log(prior.variance[k]);
  }
  const double determinant =
      prior.variance[preload] * prior.variance[rate] - prior.spring_covariance * prior.spring_covariance;
  factor[preload * magnitudes + preload] += prior.variance[rate] / determinant;
  factor[rate * magnitudes + rate] += prior.variance[preload] / determinant;
  factor[preload * magnitudes + rate] -= prior.spring_covariance / determinant;
  factor[rate * magnitudes + preload] -= prior.spring_covariance / determinant;
  scale += std::log(determinant);
  if (!factorise(factor, magnitudes)) return out;
  out.value = pull;
  solve_in_place(factor, magnitudes, out.value);
  out.evidence = 0.5 * product(pull, out.value) - 0.5 * (log_determinant(factor, magnitudes) + scale);
  for (std::size_t k = 0; k < magnitudes; ++k) {
    Magnitudes unit{};
    unit[k] = 1;
    solve_in_place(factor, magnitudes, unit);
    out.deviation[k] = std::sqrt(unit[k]);
  }
  return out;
}

/// Lost spring force and shorted turns pull opposite ways with much the same shape over the position: together they
/// imitate small errors of the maps. A set with both explains nothing.
bool cancels(unsigned set) {
  return has(set, Fault::spring) && has(set, Fault::coil);
}

/// What wears the lands wears the edges, too: given one of the two, the other is as likely as this.
constexpr double edges_beside_friction = 1;

double log_prior(unsigned set) {
  double out = std::popcount(set) * std::log(prior_odds);
  if (has(set, Fault::friction) && has(set, Fault::edge_wear)) out += std::log(edges_beside_friction / prior_odds);
  return out;
}

bool left_out(unsigned set) {
  return std::popcount(set) > largest_set || cancels(set);
}

/// Whether wear can go that way.
bool possible(unsigned set, const Magnitudes& value) {
  const auto of = [&](Magnitude magnitude) { return value[index(magnitude)]; };
  if (has(set, Fault::friction) && of(Magnitude::friction) < 0) return false;
  if (has(set, Fault::edge_wear) && of(Magnitude::edge_rounding) < 0) return false;
  if (has(set, Fault::spring) && of(Magnitude::preload_loss) + rate_beside_preload * of(Magnitude::rate_loss) < 0)
    return false;
  return !(has(set, Fault::coil) && of(Magnitude::shorted_turns) < 0);
}

}  // namespace

Isolation isolate(const Evidence& evidence, const Magnitudes& centre, const Magnitudes& spread) {
  const Magnitudes pull = pull_about(evidence, centre);
  std::array<Explanation, sets> of_set;
  std::array<double, sets> weight{};
  double most = -1e300;
  unsigned best = 0;
  for (unsigned set = 0; set < sets; ++set) {
    if (left_out(set)) continue;
    of_set[set] = explain_by(evidence, pull, prior_of(set, spread));
    if (!possible(set, of_set[set].value)) of_set[set].evidence = -1e300;
    weight[set] = of_set[set].evidence + log_prior(set);
    if (weight[set] > most) {
      most = weight[set];
      best = set;
    }
  }
  Isolation out;
  std::array<double, isolated_faults> with{}, without{};
  double all = 0;
  for (unsigned set = 0; set < sets; ++set) {
    if (left_out(set)) continue;
    const double share = std::exp(weight[set] - most);
    all += share;
    for (std::size_t f = 0; f < isolated_faults; ++f) ((set >> f & 1U) != 0 ? with : without)[f] += share;
  }
  for (std::size_t f = 0; f < isolated_faults; ++f) {
    out.odds[f] = std::clamp(with[f] / std::max(without[f], 1e-300), 1 / most_odds, most_odds);
    out.likeliest[f] = (best >> f & 1U) != 0;
  }
  Prior anything;
  for (std::size_t k = 0; k < magnitudes; ++k) anything.variance[k] = spread[k] * spread[k] + 1;
  const double unexplained = explain_by(evidence, pull, anything).evidence - most;
  out.unexplained_odds = std::min(wrong_model_prior_odds * std::exp(std::min(unexplained, 50.0)) / all, most_odds);
  out.value = of_set[best].value;
  out.deviation = of_set[best].deviation;
  for (std::size_t k = 0; k < magnitudes; ++k) out.value[k] += centre[k];
  out.gain = of_set[best].evidence - of_set[0].evidence;
  return out;
}

Score score(const Evidence& evidence, const Magnitudes& centre, const Magnitudes& spread, Fault fault) {
  const Magnitudes pull = pull_about(evidence, centre);
  const auto own = static_cast<std::size_t>(fault);
  Magnitudes along{};
  for (std::size_t k = 0; k < magnitudes; ++k) {
    if (belongs(own, k)) along[k] = k == index(Magnitude::rate_loss) ? rate_beside_preload : 1.0;
  }
  // Others vary as healthy ones do: H - H (H_oo + V_o^-1)^-1 H.
  MagnitudeMatrix others = evidence.information;
  for (std::size_t k = 0; k < magnitudes; ++k) {
    others[k * magnitudes + k] += 1 / (spread[k] * spread[k]);
    if (along[k] == 0) continue;
    for (std::size_t j = 0; j < magnitudes; ++j) others[k * magnitudes + j] = others[j * magnitudes + k] = 0;
    others[k * magnitudes + k] = 1;
  }
  constexpr double nothing = std::numeric_limits<double>::infinity();
  if (!factorise(others, magnitudes)) return {0, nothing};
  Magnitudes row{};
  for (std::size_t r = 0; r < magnitudes; ++r) {
    for (std::size_t c = 0; c < magnitudes; ++c) row[r] += evidence.information[r * magnitudes + c] * along[c];
  }
  Magnitudes solved{}, cross = row;
  for (std::size_t k = 0; k < magnitudes; ++k) {
    if (along[k] != 0) cross[k] = 0;
  }
  solved = cross;
  solve_in_place(others, magnitudes, solved);
  const double information = product(along, row) - product(cross, solved);
  const double pulled = product(along, pull) - product(pull, solved);
  if (!(information > 1e-9)) return {0, nothing};
  return {pulled / information, 1 / std::sqrt(information)};
}

}  // namespace spoolflow::monitor
