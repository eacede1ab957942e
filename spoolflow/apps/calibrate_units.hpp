#pragma once
/// A type from several of its units, as `calibrate --as-type` makes it, and units of a type, as `--type` does them.
#include <vector>

#include "spoolflow/apps/calibrate_work.hpp"
#include "spoolflow/apps/elsewhere.hpp"

namespace spoolflow::apps {

/// Calibrates each campaign, writes the model of the middle of all with the spread between them, and prints that.
void calibrate_type(const CalibrateArguments& arguments);

/// Writes a model of each task's unit and says how it differs from its type; what a unit failed by is `attempt`'s.
void calibrate_units(const CalibrateArguments& arguments, const std::vector<CalibrationTask>& tasks,
                     const Attempt& attempt);

}  // namespace spoolflow::apps
