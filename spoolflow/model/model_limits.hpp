#pragma once
#include <string>

#include "spoolflow/model/model.hpp"

namespace spoolflow::model {

/// Throws ModelError, with the JSON path, where a number breaks a limit or a relation of its description: no sensor can
/// live with it. `file` names the model in the message.
void require_limits(const Model& model, const std::string& file);

}  // namespace spoolflow::model
