#pragma once
/// Words and attributes that FMI 2.0 and 3.0 share.
#include <string>

#include "spoolflow/export/fmu/variable.hpp"

namespace spoolflow::exports {

[[nodiscard]] const char* word(fmu::Causality causality);
[[nodiscard]] const char* word(fmu::Variability variability);
/// ` initial="…"` where the standard wants one: parameters are exact, outputs calculated.
[[nodiscard]] std::string initial(const fmu::Variable& variable);
/// ` min="…" max="…" nominal="…"`, each where it is known.
[[nodiscard]] std::string limits(const fmu::Variable& variable);
/// The categories that the FMU logs in.
[[nodiscard]] std::string log_categories();

}  // namespace spoolflow::exports
