#pragma once
#include <nlohmann/json.hpp>

#include "spoolflow/model/model.hpp"

namespace spoolflow::report {

/// Of a type's model, or that of one of its units, the key `type`: its `name`, and `of`, "type" or "unit".
inline void add_type(nlohmann::ordered_json& to, const model::Model& model) {
  if (model.type) to["type"] = {{"name", model.type->name}, {"of", model.type->unit ? "unit" : "type"}};
}

}  // namespace spoolflow::report
