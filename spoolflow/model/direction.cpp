#include "spoolflow/model/model.hpp"

namespace spoolflow::model {

Model of_direction(const Model& model, const std::string& direction) {
  Model out = model;
  if (!model.whole()) return out;
  out.valve.direction = direction;
  std::erase_if(out.provenance.quantities, [&](const KnownQuantity& each) { return each.direction != direction; });
  if (direction == "a") {
    out.condensed = model.p_to_a->condensed;
    out.observer = model.p_to_a->observer;
    out.evidence = model.p_to_a->evidence;
  }
  out.p_to_a.reset();
  return out;
}

}  // namespace spoolflow::model
