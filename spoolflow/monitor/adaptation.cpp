#include "spoolflow/monitor/adaptation.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/model/model_limits.hpp"
#include "spoolflow/sensor/machine_reference.hpp"

namespace spoolflow::monitor {
namespace {

constexpr const char* remedy = "repair the valve, or calibrate it again";

struct Corrected {
  Magnitude magnitude;
  double Difference::*corrects;
  Fault fault;
  const char* of;
  const char* unit;
  double factor;   ///< from usual_fault to the indicator's unit
  double at_zero;  ///< the indicator of a healthy valve
  double most;     ///< of the magnitude itself, in SI
};
constexpr std::array<Corrected, 5> corrected{{
    {Magnitude::friction, &Difference::friction_ratio, Fault::friction, "friction ratio", "1", 1, 1,
     most_friction_ratio - 1},
    {Magnitude::preload_loss, &Difference::preload_loss, Fault::spring, "spring preload ratio", "1", -1, 1,
     most_preload_loss},
    {Magnitude::rate_loss, &Difference::rate_loss, Fault::spring, "spring rate ratio", "1", -1, 1, most_rate_loss},
    {Magnitude::shorted_turns, &Difference::shorted_turns, Fault::coil, "shorted turns", "1", 1, 0, most_shorted_turns},
    {Magnitude::position_zero, &Difference::position_zero_m, Fault::position_sensor, "position zero", "m", 1, 0,
     most_position_zero_m},
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

constexpr double day_s = 86400, month_s = 30 * day_s, deviations_95 = 2, percent = 100, um_per_m = 1e6;
/// What a state is known to where its own uncertainty says less: of a healthy model, one standard deviation; and what
/// may be hidden of a quantity that references left as it was.
constexpr double least_width = sensor::ReferencePriors::model_volume_share / sensor::ReferencePriors::volume_per_width,
                 least_friction = sensor::ReferencePriors::model_friction_share, hidden_width = 0.03,
                 hidden_friction = 0.1, hidden_zero_m = 5e-6;

bool moved(const model::Adaptation& look, std::string_view quantity) {
  return std::ranges::any_of(look.corrections, [&](const model::Correction& each) { return each.of == quantity; });
}

/// A state of one quantity at a time, one standard deviation.
struct Look {
  double time_s, value, deviation;
};

WearRate slope_of(const std::vector<Look>& looks) {
  double sum = 0, time = 0, value = 0;
  for (const Look& each : looks) {
    const double weight = 1 / (each.deviation * each.deviation);
    sum += weight;
    time += weight * each.time_s;
    value += weight * each.value;
  }
  double spread = 0, along = 0;
  for (const Look& each : looks) {
    const double weight = 1 / (each.deviation * each.deviation), off_s = each.time_s - time / sum;
    spread += weight * off_s * off_s;
    along += weight * off_s * (each.value - value / sum);
  }
  return {month_s * along / spread, month_s * deviations_95 / std::sqrt(spread)};
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
      difference.*each.corrects += value;
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

std::optional<WearDrift> wear_drift(const model::Provenance& provenance, const std::string& direction) {
  const auto created_s = model::seconds_of(provenance.created);
  if (!created_s) return {};
  const auto calibrated_s = static_cast<double>(*created_s);
  std::vector<Look> width{{calibrated_s, 0, least_width}}, friction{{calibrated_s, 0, least_friction}},
      zero{{calibrated_s, 0, sensor::ReferencePriors::closed_uncertainty_m}};
  double last_s = calibrated_s;
  for (const model::Adaptation& each : provenance.adaptations) {
    const auto looked_s = model::seconds_of(each.created);
    if (!each.wear || !looked_s || each.direction != direction) continue;
    const auto time_s = static_cast<double>(*looked_s);
    const model::WearState& wear = *each.wear;
    const auto known = [&](std::string_view of, double least, double hidden) {
      return moved(each, of) ? least : std::hypot(least, hidden);
    };
    width.push_back(
        {time_s, wear.edge_width,
         known("edge width", std::max(least_width, wear.flow_share / sensor::ReferencePriors::volume_per_width),
               hidden_width)});
    friction.push_back({time_s, wear.friction_ratio - 1,
                        wear.friction_ratio *
                            known("friction ratio", std::max(least_friction, wear.friction_share), hidden_friction)});
    zero.push_back({time_s, wear.position_zero_m,
                    known("position zero", sensor::ReferencePriors::closed_uncertainty_m, hidden_zero_m)});
    last_s = std::max(last_s, time_s);
  }
  if (last_s - calibrated_s < day_s) return {};
  return WearDrift{slope_of(width), slope_of(friction), slope_of(zero), width.size() - 1,
                   (last_s - calibrated_s) / day_s};
}

std::string text_of(const WearDrift& drift) {
  const auto rate = [](const WearRate& of, double scale, const char* unit) {
    return fmt::format("{:+.2g} +- {:.2g} {}", scale * of.value, scale * of.uncertainty_95, unit);
  };
  return fmt::format("in 30 days: edge width {}, friction {}, position zero {} ({} looks in {:.0f} days)",
                     rate(drift.edge_width, percent, "%"), rate(drift.friction, percent, "%"),
                     rate(drift.position_zero_m, um_per_m, "um"), drift.looks, drift.days);
}

std::vector<std::string> drift_texts(const model::Model& model) {
  std::vector<std::string> out;
  for (const std::string& direction : model::directions(model)) {
    const auto drift = wear_drift(model.provenance, model.whole() ? direction : "");
    const std::string whose = model.whole() ? fmt::format("{} ", model::flow_of(direction)) : "";
    if (drift) out.push_back(whose + text_of(*drift));
  }
  return out;
}

}  // namespace spoolflow::monitor
