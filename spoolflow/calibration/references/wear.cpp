#include "spoolflow/calibration/references/wear.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "spoolflow/numerics/sum_of_squares.hpp"

namespace spoolflow::calibration {
namespace {

Deviations deviations_of(const model::WearState& wear) {
  Deviations out{};
  out[at(Variation::edge_width)] = wear.edge_width;
  out[at(Variation::position_zero)] = wear.position_zero_m;
  return out;
}

}  // namespace

sensor::ObserverParameters<double> worn(const sensor::ObserverParameters<double>& valve, const model::WearState& wear) {
  sensor::ObserverParameters<double> out = unit_parameters(valve, deviations_of(wear));
  out.friction.operation_ratio *= wear.friction_ratio;
  return out;
}

sensor::CondensedParameters<double> worn(const sensor::CondensedParameters<double>& valve,
                                         const model::WearState& wear) {
  sensor::CondensedParameters<double> out = unit_parameters(valve, deviations_of(wear));
  for (double& friction_N : out.friction_half_width_N.values) friction_N *= wear.friction_ratio;
  return out;
}

std::vector<model::WearState> wear_states(const model::Model& model) {
  std::vector<model::WearState> out{{}};
  for (const model::Adaptation& each : model.provenance.adaptations)
    if (each.wear) out.push_back(*each.wear);
  return out;
}

model::WearState wear_of(const model::Model& model) {
  return model::last_wear(model.provenance);
}

std::vector<std::string> corrected_in_all_states(const model::Model& model) {
  std::vector<std::string> out;
  for (const model::Adaptation& each : model.provenance.adaptations) {
    if (each.wear || each.corrections.empty()) continue;
    std::vector<std::string> what;
    for (const model::Correction& correction : each.corrections)
      what.push_back(fmt::format("{} ({:.3g}{})", correction.of, correction.value,
                                 correction.unit == "1" ? "" : " " + correction.unit));
    out.push_back(fmt::format(
        "`monitor --adapt` corrected {} by {}, and every state has that; the model before it has the SHA-256 {}",
        fmt::join(what, ", "), fmt::join(each.files, ", "), each.adapted_from));
  }
  return out;
}

model::Model moved(const model::Model& model, const model::WearState& to) {
  const model::WearState from = wear_of(model);
  model::Model out = model;
  if (from == to) return out;
  const model::WearState change{(1 + to.edge_width) / (1 + from.edge_width) - 1,
                                to.friction_ratio / from.friction_ratio, to.position_zero_m - from.position_zero_m};
  sensor::ObserverParameters<double>& valve = out.observer->parameters;
  valve = worn(valve, change);
  valve.environment.flow_share = numerics::with_instead(valve.environment.flow_share, from.flow_share, to.flow_share);
  // It is the same at all samples: forces count for less, and the band holds it however many of them are averaged.
  for (double* share : {&valve.band.friction_share, &valve.environment.friction_share})
    *share = numerics::with_instead(*share, from.friction_share, to.friction_share);
  out.condensed.parameters = worn(out.condensed.parameters, change);
  return out;
}

}  // namespace spoolflow::calibration
