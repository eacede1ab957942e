#include "spoolflow/apps/work/band_notes.hpp"

#include <fmt/format.h>

namespace spoolflow::apps {

std::string type_note(const model::Model& model, const std::string& file) {
  if (!model.type || model.type->unit) return {};
  return fmt::format(
      "{}: the model of the type {}: its band and what counts as healthy hold any unit; for those of this unit: "
      "spoolflow calibrate UNIT.toml --type {} -o UNIT.json",
      file, model.type->name, file);
}

std::string bench_note(const model::Model& model) {
  if (!model.observer || !sensor::is_bench(model.observer->parameters.environment)) return {};
  return "the band is that of bench conditions: what a machine leaves open (oil, position's zero, friction, vibration, "
         "ripple) is not in it; for a machine's recording add --environment machine";
}

}  // namespace spoolflow::apps
