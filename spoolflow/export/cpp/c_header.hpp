#pragma once
/// The header of an exported folder for firmware in C.
#include <string>

#include "spoolflow/model/model.hpp"

namespace spoolflow::exports {

/// `text`: of cpp/valve_sensor.h.in, whose open places are filled for the best sensor of the model.
[[nodiscard]] std::string c_header(std::string text, const model::Model& model);

}  // namespace spoolflow::exports
