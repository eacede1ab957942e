#pragma once
/// The page that an engineer opens first: how good the sensor is, on what, and why not better.
#include <iosfwd>

#include "spoolflow/model/model.hpp"
#include "spoolflow/report/text/reader_units.hpp"
#include "spoolflow/report/validation/comparison.hpp"
#include "spoolflow/validation/validate.hpp"

namespace spoolflow::report {

/// `others` stand beside it.
void write_validation_report(std::ostream& out, const model::Model& model, const validation::Validation& validation,
                             const std::vector<ComparedValidation>& others = {}, const ReaderUnits& units = {});
/// What was calibrated, from the model alone.
void write_calibration_report(std::ostream& out, const model::Model& model, const ReaderUnits& units = {});

}  // namespace spoolflow::report
