#pragma once
#include <iosfwd>
#include <vector>

#include "spoolflow/model/model.hpp"
#include "spoolflow/validation/validate.hpp"

namespace spoolflow::report {

/// All figures of `validate` as JSON; units in the key names, % FS of the rated flow.
void write_metrics(std::ostream& out, const model::Model& model, const std::vector<validation::ValidatedRun>& runs,
                   const validation::ValidationOptions& options);

}  // namespace spoolflow::report
