#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "spoolflow/export/fmu/variable.hpp"

namespace spoolflow::exports {

/// `<UnitDefinitions>` of exactly the units that the variables name, each with its display units; FMI 2.0 and 3.0 write
/// them alike. Throws std::logic_error for a unit that this table does not know.
[[nodiscard]] std::string unit_definitions(const std::vector<fmu::Variable>& variables);

/// Attributes of the unit's BaseUnit element: SI exponents. Throws std::logic_error for an unknown name.
[[nodiscard]] std::string_view base_unit(std::string_view unit);

}  // namespace spoolflow::exports
