#include "spoolflow/model/model.hpp"

#include <utility>

namespace spoolflow::model {

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
