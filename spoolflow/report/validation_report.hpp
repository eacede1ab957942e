#pragma once
#include <iosfwd>
#include <vector>

#include "spoolflow/model/model.hpp"
#include "spoolflow/validation/validate.hpp"

namespace spoolflow::report {

/// One self-contained HTML page: verdict, the valve and its data, maps, each run, blind zones.
void write_validation_report(std::ostream& out, const model::Model& model,
                             const std::vector<validation::ValidatedRun>& runs,
                             const validation::ValidationOptions& options);
/// The same without runs: what was calibrated, and how well.
void write_calibration_report(std::ostream& out, const model::Model& model);
/// One sentence: how close, on which run, and what holds it back.
[[nodiscard]] std::string verdict(const model::Model& model, const std::vector<validation::ValidatedRun>& runs);

}  // namespace spoolflow::report
