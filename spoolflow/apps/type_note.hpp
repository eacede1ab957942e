#pragma once
#include <string>

#include "spoolflow/model/model.hpp"

namespace spoolflow::apps {

/// Where the model, of `file`, is of a type and of none of its units: says so, and how a unit gets its own.
void say_of_type(const model::Model& model, const std::string& file, bool quiet);

}  // namespace spoolflow::apps
