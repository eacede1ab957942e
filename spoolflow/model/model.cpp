#include "spoolflow/model/model.hpp"

#include <cmath>
#include <utility>

#include "spoolflow/units/conversion.hpp"

namespace spoolflow::model {

double viscosity_m2_per_s(const Fluid& fluid, double oil_temperature_K) {
  constexpr double of_hlp46_40C_m2_per_s = 46e-6, of_hlp46_100C_m2_per_s = 6.8e-6;
  const double at_40C = fluid.viscosity_40C_m2_per_s.value_or(0), at_100C = fluid.viscosity_100C_m2_per_s.value_or(0);
  const bool given = at_100C > 0 && at_40C > at_100C;
  const auto twice_log = [](double viscosity_m2_per_s) {
    return std::log10(std::log10(viscosity_m2_per_s / units::m2_per_s_per_mm2_per_s + 0.7));
  };
  const double warm = twice_log(given ? at_40C : of_hlp46_40C_m2_per_s),
               hot = twice_log(given ? at_100C : of_hlp46_100C_m2_per_s);
  const double warm_K = units::K_from_degC(40), hot_K = units::K_from_degC(100);
  const double twice = warm + (hot - warm) * std::log10(oil_temperature_K / warm_K) / std::log10(hot_K / warm_K);
  return units::m2_per_s_from_mm2_per_s(std::pow(10.0, std::pow(10.0, twice)) - 0.7);
}

Model of_direction(const Model& model, const std::string& direction) {
  Model out = model;
  if (!model.whole()) return out;
  out.valve.direction = direction;
  std::erase_if(out.provenance.quantities, [&](const KnownQuantity& each) { return each.direction != direction; });
  std::erase_if(out.provenance.adaptations,
                [&](const Adaptation& each) { return !each.direction.empty() && each.direction != direction; });
  for (Adaptation& each : out.provenance.adaptations) each.direction.clear();
  if (direction == "a") {
    out.condensed = model.p_to_a->condensed;
    out.observer = model.p_to_a->observer;
    out.evidence = model.p_to_a->evidence;
    out.type = model.p_to_a->type;
  }
  out.p_to_a.reset();
  return out;
}

void put_direction(Model& model, const std::string& direction, Model of_one) {
  if (model.whole() && direction == "a") {
    model.p_to_a = Direction{std::move(of_one.condensed), std::move(of_one.observer), std::move(of_one.evidence),
                             std::move(of_one.type)};
    return;
  }
  model.condensed = std::move(of_one.condensed);
  model.observer = std::move(of_one.observer);
  model.evidence = std::move(of_one.evidence);
  model.type = std::move(of_one.type);
}

const char* flow_of(const std::string& direction) {
  return direction == "a" ? "P to A" : "P to B";
}

std::vector<std::string> directions(const Model& model) {
  return model.whole() ? std::vector<std::string>{"b", "a"} : std::vector{model.valve.direction};
}

}  // namespace spoolflow::model
