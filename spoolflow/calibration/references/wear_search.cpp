#include "spoolflow/calibration/references/wear_search.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <set>
#include <tuple>

#include "spoolflow/parallel/for_each.hpp"

namespace spoolflow::calibration {
namespace {

std::vector<PassedOil> all_oil(const MachineEvidence& evidence) {
  std::vector<PassedOil> out;
  for (const WatchedRun& run : evidence.runs) out.insert(out.end(), run.oil.begin(), run.oil.end());
  return out;
}

std::vector<bool> used_of(const WearView& view) {
  std::vector<bool> out;
  for (const OilRatio& each : view.ratios) out.push_back(each.used);
  return out;
}

model::WearState with_friction(model::WearState wear, double log_ratio) {
  wear.friction_ratio *= std::exp(log_ratio);
  return wear;
}

model::WearState with_edge(model::WearState wear, double log_ratio) {
  wear.edge_width = (1 + wear.edge_width) * std::exp(log_ratio) - 1;
  return wear;
}

/// What is to be expected of a change that reads `value` within `deviation` where wear makes it `usual` large.
Change of_measured(double value, double deviation, double usual) {
  const double kept = usual * usual / (usual * usual + deviation * deviation);
  return {kept * value, std::sqrt(kept) * deviation, evidence_of_change(value, deviation, usual)};
}

/// The same view with the edges so wide that the sensor's volumes are those of the references, by the agreement of that
/// view; wear does not narrow them.
WearView with_asked_edges(const MachineEvidence& evidence, const WearView& view, const OilAgreement& oil,
                          const std::vector<bool>& used) {
  constexpr double width_per_volume = 1 / sensor::ReferencePriors::volume_per_width, most = 0.2;
  const double asked = std::clamp(width_per_volume * oil.log_ratio, 0.0, most);
  return asked > 0 ? seen_with(evidence, with_edge(view.wear, asked), used) : view;
}

/// Without the constant.
double log_normal(double value, double deviation) {
  return -0.5 * std::pow(value / deviation, 2) - std::log(deviation);
}

/// Above 0 however far below.
double normal_share_below(double deviations) {
  return std::max(0.5 * std::erfc(-deviations / std::numbers::sqrt2), std::numeric_limits<double>::min());
}

/// Of the oil beside the sensor's where wear may have changed the edges by what is usual, but not to below the
/// calibrated ones: a normal cut off there.
double log_likelihood_of_wider_edges(const OilAgreement& oil, double edge_width) {
  constexpr double usual = Priors::volume_per_width * edge_wear;
  const double narrowest = -Priors::volume_per_width * std::log1p(edge_width), both = std::hypot(usual, oil.deviation),
               asked = oil.log_ratio * std::pow(usual / both, 2), known = usual * oil.deviation / both;
  return log_normal(oil.log_ratio, both) +
         std::log(normal_share_below((asked - narrowest) / known) / normal_share_below(-narrowest / usual));
}

/// What the model makes of friction errs by itself, alike in all directions: so may the friction tried.
PerFriction as_the_model_errs(const PerFriction& log_likelihood) {
  const double most = *std::ranges::max_element(log_likelihood);
  PerFriction out{};
  for (std::size_t k = 0; k < tried_frictions; ++k) {
    double weights = 0, sum = 0;
    for (std::size_t j = 0; j < tried_frictions; ++j) {
      const double apart = (tried_log_friction(j) - tried_log_friction(k)) / Priors::model_friction_share,
                   weight = std::exp(-0.5 * apart * apart);
      weights += weight;
      sum += weight * std::exp(log_likelihood[j] - most);
    }
    out[k] = std::log(sum / weights) + most;
  }
  return out;
}

}  // namespace

double tried_log_friction(std::size_t k) {
  constexpr double step = 0.1;
  return step * (static_cast<double>(k) - static_cast<double>(same_friction));
}

double evidence_of_change(double value, double deviation, double usual) {
  const double narrow = deviation * deviation, wide = narrow + usual * usual;
  return 0.5 * value * value * (1 / narrow - 1 / wide) - 0.5 * std::log(wide / narrow);
}

Change position_zero_change(const MachineEvidence& evidence) {
  if (!evidence.closed_m) return {};
  const double value_m = *evidence.closed_m - evidence.model.observer->parameters.edge.position_m.first;
  const double gain = evidence_of_change(value_m, closed_uncertainty_m, position_zero_wear_m);
  return {value_m, closed_uncertainty_m, gain, gain > change_evidence};
}

WearView seen_with(const MachineEvidence& evidence, const model::WearState& wear, const std::vector<bool>& used) {
  const model::Model valve = moved(evidence.model, wear);
  const double rated_m3_per_s = valve.valve.rated_flow_m3_per_s;
  const SensorView view = view_through(valve.observer->parameters, rated_m3_per_s, evidence.runs);
  WearView out{wear, oil_ratios(all_oil(evidence), view.volume_m3, rated_m3_per_s), 0};
  if (used.empty()) leave_out_apart(out.ratios);
  for (std::size_t k = 0; k < used.size(); ++k) out.ratios[k].used = out.ratios[k].used && used[k];
  for (std::size_t r = 0; r < evidence.references.size(); ++r) out.loss += level_of(out.ratios, r).loss;
  out.loss += breakaway_weight * view.breakaway_loss;
  return out;
}

OilAgreement agreement_of(const MachineEvidence& evidence, const WearView& view) {
  double weights = 0, sum = 0;
  std::set<std::tuple<recording::ReferenceKind, double, double>> stated;
  for (std::size_t r = 0; r < evidence.references.size(); ++r) {
    const OilLevel level = level_of(view.ratios, r);
    if (level.count == 0) continue;
    const recording::Reference& reference = evidence.references[r];
    stated.insert({reference.kind, reference.area_m2, reference.displacement_m3_per_rad});
    const double weight = 1 / (level.deviation * level.deviation + std::pow(0.5 * reference.share_uncertainty, 2));
    weights += weight;
    sum += weight * level.log_ratio;
  }
  if (!(weights > 0)) return {0, 0, 0};
  return {sum / weights, std::hypot(std::sqrt(1 / weights), model_volume_share), stated.size()};
}

EdgeChange wear_or_misstated(const OilAgreement& oil, double slope) {
  const double asked = oil.log_ratio / slope;
  const Change wear = of_measured(asked, oil.deviation / slope, edge_wear),
               misstated = of_measured(asked, std::hypot(oil.deviation, Priors::misstated_share) / slope, edge_wear);
  EdgeChange out{wear, asked, sensor::misstated_evidence(oil.log_ratio, oil.deviation * oil.deviation), oil.log_ratio};
  out.deviation = std::hypot(wear.deviation, wear.value - misstated.value);
  return out;
}

EdgeChange edge_change(const MachineEvidence& evidence, const WearView& from) {
  const OilAgreement here = agreement_of(evidence, from);
  if (!(here.deviation > 0)) return {};
  const std::vector<bool> used = used_of(from);
  const double turn = here.log_ratio < 0 ? -edge_wear : edge_wear;
  const OilAgreement there = agreement_of(evidence, seen_with(evidence, with_edge(from.wear, turn), used));
  const double slope = (here.log_ratio - there.log_ratio) / turn;  // of the sensor's volume over the width
  constexpr double least_slope = 0.2;                              // less is not oil that an edge passes
  if (!(slope > least_slope)) return {};
  // Different references are not misstated alike.
  EdgeChange out =
      here.references > 1
          ? EdgeChange{of_measured(here.log_ratio / slope, here.deviation / slope, edge_wear), here.log_ratio / slope}
          : wear_or_misstated(here, slope);
  const bool possible = with_edge(from.wear, out.value).edge_width > 0;
  out.taken = possible && (out.evidence > change_evidence || from.wear != model::WearState{});
  return out;
}

SeenFriction seen_friction(const MachineEvidence& evidence, const WearView& from) {
  const std::vector<bool> used = used_of(from);
  SeenFriction out{{}, {}, from.wear != model::WearState{}};
  if (!(agreement_of(evidence, from).deviation > 0)) return out;  // no oil, nothing seen
  parallel::for_each(tried_frictions, parallel::cores(), [&](std::size_t k) {
    const WearView view = seen_with(evidence, with_friction(from.wear, tried_log_friction(k)), used);
    const OilAgreement oil = agreement_of(evidence, view);
    const double loss = with_asked_edges(evidence, view, oil, used).loss;
    out.with_these_edges[k] = log_normal(oil.log_ratio, oil.deviation) - loss;
    out.with_wider_edges[k] = log_likelihood_of_wider_edges(oil, from.wear.edge_width) - loss;
  });
  return out;
}

Change friction_change(std::span<const SeenFriction> seen) {
  PerFriction wider{}, same{};
  bool wears = false;
  for (const SeenFriction& each : seen) {
    std::ranges::transform(wider, each.with_wider_edges, wider.begin(), std::plus{});
    std::ranges::transform(same, each.with_these_edges, same.begin(), std::plus{});
    wears = wears || each.wears;
  }
  const PerFriction log_likelihood = as_the_model_errs(wider);
  const double most = *std::ranges::max_element(log_likelihood);
  double expected = 0, weights = 0, mean = 0, square = 0;
  for (std::size_t k = 0; k < tried_frictions; ++k) {
    const double log_ratio = tried_log_friction(k), usual = std::exp(-0.5 * std::pow(log_ratio / friction_wear, 2)),
                 weight = usual * std::exp(log_likelihood[k] - most);
    expected += usual;
    weights += weight;
    mean += weight * log_ratio;
    square += weight * log_ratio * log_ratio;
  }
  mean /= weights;
  const double none = as_the_model_errs(same)[same_friction];
  Change out{mean, std::sqrt(square / weights - mean * mean), std::log(weights / expected) + most - none};
  out.taken = out.evidence > change_evidence || wears;
  return out;
}

}  // namespace spoolflow::calibration
