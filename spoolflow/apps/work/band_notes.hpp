#pragma once
/// What the user should know of a band before it is relied on.
#include <string>

#include "spoolflow/model/model.hpp"

namespace spoolflow::apps {

/// Where the model, of `file`, is of a type and of none of its units: a line that says so, and how a unit gets its own.
/// Empty: it is not.
[[nodiscard]] std::string type_note(const model::Model& model, const std::string& file);

/// Where the model's environment leaves nothing open, as on a bench: a line that says so, and how a machine is
/// declared. Empty: it leaves something open, or the model has no observer.
[[nodiscard]] std::string bench_note(const model::Model& model);

}  // namespace spoolflow::apps
