#include "spoolflow/calibration/references/wear_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>

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

/// Three points of a loss at equal steps, and the parabola through them.
struct Parabola {
  double middle, step;
  std::array<double, 3> loss;
  [[nodiscard]] double curvature() const { return (loss[0] - 2 * loss[1] + loss[2]) / (step * step); }
  [[nodiscard]] double vertex() const {
    if (!(curvature() > 0)) return middle;
    return middle + std::clamp(0.5 * (loss[0] - loss[2]) / (curvature() * step), -step, step);
  }
};

/// What is to be expected of a change that reads `value` within `deviation` where wear makes it `usual` large.
Change of_measured(double value, double deviation, double usual) {
  const double kept = usual * usual / (usual * usual + deviation * deviation);
  return {kept * value, std::sqrt(kept) * deviation, evidence_of_change(value, deviation, usual)};
}

/// The same view with the edges so wide that the sensor's volumes are those of the references; wear does not narrow
/// them.
WearView with_asked_edges(const MachineEvidence& evidence, WearView view, const std::vector<bool>& used) {
  constexpr double width_per_volume = 1 / sensor::ReferencePriors::volume_per_width, most = 0.2;
  const double asked = std::clamp(width_per_volume * agreement_of(evidence, view).log_ratio, 0.0, most);
  return asked > 0 ? seen_with(evidence, with_edge(view.wear, asked), used) : view;
}

}  // namespace

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
  out.loss += view.sliding_loss_s / innovation_memory_s;
  return out;
}

OilAgreement agreement_of(const MachineEvidence& evidence, const WearView& view) {
  double weights = 0, sum = 0;
  for (std::size_t r = 0; r < evidence.references.size(); ++r) {
    const OilLevel level = level_of(view.ratios, r);
    if (level.count == 0) continue;
    const double weight =
        1 / (level.deviation * level.deviation + std::pow(0.5 * evidence.references[r].share_uncertainty, 2));
    weights += weight;
    sum += weight * level.log_ratio;
  }
  if (!(weights > 0)) return {0, 0};
  return {sum / weights, std::hypot(std::sqrt(1 / weights), model_volume_share)};
}

Change edge_change(const MachineEvidence& evidence, const WearView& from) {
  const OilAgreement here = agreement_of(evidence, from);
  if (!(here.deviation > 0)) return {};
  const std::vector<bool> used = used_of(from);
  const double turn = here.log_ratio < 0 ? -edge_wear : edge_wear;
  const OilAgreement there = agreement_of(evidence, seen_with(evidence, with_edge(from.wear, turn), used));
  const double slope = (here.log_ratio - there.log_ratio) / turn;  // of the sensor's volume over the width
  constexpr double least_slope = 0.2;                              // less is not oil that an edge passes
  if (!(slope > least_slope)) return {};
  Change out = of_measured(here.log_ratio / slope, here.deviation / slope, edge_wear);
  const bool possible = with_edge(from.wear, out.value).edge_width > 0;
  out.taken = possible && (out.evidence > change_evidence || from.wear != model::WearState{});
  return out;
}

SeenFriction seen_friction(const MachineEvidence& evidence, const WearView& from, const Change& edges) {
  constexpr double step = 0.1, furthest = 1.0;
  const std::vector<bool> used = used_of(from);
  const auto loss_at = [&](double log_ratio) {
    return with_asked_edges(evidence, seen_with(evidence, with_friction(from.wear, log_ratio), used), used).loss;
  };
  Parabola at{0, step, {loss_at(-step), loss_at(0), loss_at(step)}};
  while (at.loss[2] < at.loss[1] && at.middle < furthest)
    at = {at.middle + step, step, {at.loss[1], at.loss[2], loss_at(at.middle + 2 * step)}};
  while (at.loss[0] < at.loss[1] && at.middle > -furthest)
    at = {at.middle - step, step, {loss_at(at.middle - 2 * step), at.loss[0], at.loss[1]}};
  constexpr double hardly_known = 4 * friction_wear;
  const double deviation = 1 / std::sqrt(std::max(at.curvature(), 1 / (hardly_known * hardly_known)));
  return {at.vertex(), deviation, edges.value > 0 ? std::max(edges.evidence, 0.0) : 0, from.wear != model::WearState{}};
}

Change friction_change(std::span<const SeenFriction> seen) {
  double weights = 0, sum = 0, beside = 0;
  bool wears = false;
  for (const SeenFriction& each : seen) {
    const double weight = 1 / (each.deviation * each.deviation);
    weights += weight;
    sum += weight * each.log_ratio;
    beside += each.beside;
    wears = wears || each.wears;
  }
  // What the model makes of friction errs alike in both directions.
  const double deviation = std::hypot(1 / std::sqrt(weights), Priors::model_friction_share);
  Change out = of_measured(sum / weights, deviation, friction_wear);
  out.taken = out.evidence + beside > change_evidence || wears;
  return out;
}

}  // namespace spoolflow::calibration
