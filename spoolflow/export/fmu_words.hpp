#pragma once
/// Words, attributes and units that FMI 2.0 and 3.0 share.
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

[[nodiscard]] const char* word(fmu::Causality causality);
[[nodiscard]] const char* word(fmu::Variability variability);
/// ` initial="…"` where the standard wants one: parameters are exact, outputs calculated.
[[nodiscard]] std::string initial(const fmu::Variable& variable);
/// ` min="…" max="…" nominal="…"`, each where it is known.
[[nodiscard]] std::string limits(const fmu::Variable& variable);
/// The categories that the FMU logs in.
[[nodiscard]] std::string log_categories();

}  // namespace spoolflow::exports
