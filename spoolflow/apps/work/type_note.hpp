#pragma once
#include <string>

#include "spoolflow/model/model.hpp"

namespace spoolflow::apps {

/// Where the model, of `file`, is of a type and of none of its units: a line that says so, and how a unit gets its own.
/// Empty: it is not.
[[nodiscard]] std::string type_note(const model::Model& model, const std::string& file);

}  // namespace spoolflow::apps
