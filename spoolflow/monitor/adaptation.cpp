#include "spoolflow/monitor/adaptation.hpp"

#include <cmath>

#include <fmt/format.h>

#include "spoolflow/model/model_limits.hpp"

namespace spoolflow::monitor {
namespace {

constexpr const char* remedy = "repair the valve, or calibrate it again";

struct Corrected {
  Magnitude magnitude;
  Fault fault;
  const char* of;
  const char* unit;
  double factor;   ///< from usual_fault to the indicator's unit
  double at_zero;  ///< the indicator of a healthy valve
  double most;     ///< of the magnitude itself, in SI
};
constexpr std::array<Corrected, 5> corrected{{
    {Magnitude::friction, Fault::friction, "friction ratio", "1", 1, 1, most_friction_ratio - 1},
    {Magnitude::preload_loss, Fault::spring, "spring preload ratio", "1", -1, 1, most_preload_loss},
    {Magnitude::rate_loss, Fault::spring, "spring rate ratio", "1", -1, 1, most_rate_loss},
    {Magnitude::shorted_turns, Fault::coil, "shorted turns", "1", 1, 0, most_shorted_turns},
    {Magnitude::position_zero, Fault::position_sensor, "position zero", "m", 1, 0, most_position_zero_m},
}};

bool explains(const DirectionFindings& side, Fault fault) {
  return side.raised && side.likeliest[static_cast<std::size_t>(fault)];
}

/// What of a side is corrected, each within its limit.
std::vector<Corrected> wanted(const model::Model& model, const DirectionFindings& side) {
  std::vector<Corrected> out;
  for (const Corrected& each : corrected) {
    if (!explains(side, each.fault) || (model.whole() && each.fault == Fault::position_sensor)) continue;
    const std::size_t k = index(each.magnitude);
    const double value = usual_fault[k] * side.value[k];
    if (!(std::abs(value) <= each.most)) {
      throw model::ModelError(
          fmt::format("{}: {} {:.3g} {} lies beyond what is corrected (from {:.3g} to {:.3g} {}); {}", model.valve.name,
                      each.of, each.at_zero + each.factor * value, each.unit, each.at_zero - each.most,
                      each.at_zero + each.most, each.unit, remedy));
    }
    out.push_back(each);
  }
  return out;
}

void put(Difference& difference, Magnitude magnitude, double value) {
  switch (magnitude) {
    case Magnitude::friction:
      difference.friction_ratio = 1 + value;
      break;
    case Magnitude::preload_loss:
      difference.preload_loss = value;
      break;
    case Magnitude::rate_loss:
      difference.rate_loss = value;
      break;
    case Magnitude::shorted_turns:
      difference.shorted_turns = value;
      break;
    case Magnitude::position_zero:
      difference.position_zero_m = value;
      break;
    case Magnitude::edge_rounding:
      break;
  }
}

/// What was raised, and cannot be corrected.
std::string left_over(const model::Model& model, const Findings& findings) {
  bool any = false, edge = false, zero = false, none = true;
  for (const DirectionFindings& side : findings.side) {
    any = any || side.raised;
    edge = edge || explains(side, Fault::edge_wear);
    zero = zero || (model.whole() && explains(side, Fault::position_sensor));
    for (const bool each : side.likeliest) none = none && !(side.raised && each);
  }
  if (!any) return "no indicator is raised, so that there is nothing to correct; leave out --adapt";
  if (edge) return fmt::format("edge wear changes the flow that a force means, and is not corrected; {}", remedy);
  if (zero) return "the zero of a whole valve is not corrected: its sensor finds it at rest in the centre";
  return fmt::format(
      "{}; {}", none ? "no fault explains what is raised" : "what is raised is none of what can be corrected", remedy);
}

}  // namespace

model::Model adapted(const model::Model& model, const Findings& findings, model::Adaptation how) {
  if (!model.has_observer()) throw model::ModelError(model.valve.name + ": the model has no observer to correct");
  model::Model out = model;
  for (std::size_t s = 0; s < findings.side.size(); ++s) {
    if (s == 1 && !model.whole()) break;
    const DirectionFindings& side = findings.side[s];
    const std::string direction = model.whole() ? (s == 1 ? "a" : "b") : model.valve.direction;
    Difference difference;
    for (const Corrected& each : wanted(model, side)) {
      const std::size_t k = index(each.magnitude);
      const double value = usual_fault[k] * side.value[k];
      put(difference, each.magnitude, value);
      how.corrections.push_back(
          {direction, each.of, each.unit, each.at_zero + each.factor * value, 2 * usual_fault[k] * side.deviation[k]});
    }
    model::Condensed& condensed = s == 1 ? out.p_to_a->condensed : out.condensed;
    sensor::ObserverParameters<double>& valve = (s == 1 ? out.p_to_a->observer : out.observer)->parameters;
    apply(difference, model.valve.stroke_m, valve);
    if (difference.friction_ratio != 1)
      valve.band.friction_share = std::hypot(valve.band.friction_share, identified_friction_share);
    apply(difference, model.valve.stroke_m, condensed.parameters);
    condensed.current_A.lower /= 1 - difference.shorted_turns;
    condensed.current_A.upper /= 1 - difference.shorted_turns;
  }
  if (how.corrections.empty())
    throw model::ModelError(fmt::format("{}: {}", model.valve.name, left_over(model, findings)));
  out.provenance.adaptations.push_back(std::move(how));
  model::require_limits(out, "the corrected model of " + model.valve.name);
  return out;
}

}  // namespace spoolflow::monitor
