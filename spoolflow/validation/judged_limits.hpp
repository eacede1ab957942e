#pragma once
/// Whether a validation meets what was asked.
#include <vector>

#include "spoolflow/validation/requirements.hpp"
#include "spoolflow/validation/validation.hpp"

namespace spoolflow::validation {

/// In the order of the requirements.
[[nodiscard]] std::vector<JudgedLimit> judge(const Requirements& requirements, const Validation& validation,
                                             double full_scale_m3_per_s);

}  // namespace spoolflow::validation
