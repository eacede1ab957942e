#pragma once
/// The header of an exported folder for firmware in C.
#include <string>

#include "spoolflow/model/model.hpp"

namespace spoolflow::exports {

/// Of the best sensor of the model.
[[nodiscard]] std::string c_header(const model::Model& model);

}  // namespace spoolflow::exports
