#include "spoolflow/apps/work/type_note.hpp"

#include <fmt/format.h>

namespace spoolflow::apps {

std::string type_note(const model::Model& model, const std::string& file) {
  if (!model.type || model.type->unit) return {};
  return fmt::format(
      "{}: the model of the type {}: its band and what counts as healthy hold any unit; for those of this unit: "
      "spoolflow calibrate UNIT.toml --type {} -o UNIT.json",
      file, model.type->name, file);
}

}  // namespace spoolflow::apps
