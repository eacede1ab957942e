#include "spoolflow/apps/type_note.hpp"

#include "spoolflow/apps/terminal/terminal_text.hpp"

namespace spoolflow::apps {

void say_of_type(const model::Model& model, const std::string& file, bool quiet) {
  if (quiet || !model.type || model.type->unit) return;
  say("{}: the model of the type {}: its band and what counts as healthy hold any unit; for those of this unit: "
      "spoolflow calibrate UNIT.toml --type {} -o UNIT.json\n",
      file, model.type->name, file);
}

}  // namespace spoolflow::apps
