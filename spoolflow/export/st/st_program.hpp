#pragma once
/// The condensed sensor for programmable controllers: one function block in Structured Text.
#include <string>

#include "spoolflow/model/model.hpp"

namespace spoolflow::exports {

/// A file of IEC 61131-3 Structured Text with the function block SpoolflowCondensed and the valve's tables in single
/// precision; it answers as `sensor/condensed.hpp` does, but for the last digits. Throws std::invalid_argument where
/// the model knows both directions (a block serves one), or where a number does not fit into single precision.
[[nodiscard]] std::string st_program(const model::Model& model);

}  // namespace spoolflow::exports
