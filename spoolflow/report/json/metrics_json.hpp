#pragma once
#include <iosfwd>

#include "spoolflow/model/model.hpp"
#include "spoolflow/validation/validate.hpp"

namespace spoolflow::report {

/// All figures of a validation as JSON; the keys are described in docs/formats/metrics.md.
void write_metrics(std::ostream& out, const model::Model& model, const validation::Validation& validation);

}  // namespace spoolflow::report
