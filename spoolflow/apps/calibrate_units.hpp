#pragma once
/// Units of a type, as `calibrate --type` does them.
#include <vector>

#include "spoolflow/apps/calibrate_work.hpp"
#include "spoolflow/apps/elsewhere.hpp"

namespace spoolflow::apps {

/// Writes a model of each task's unit and says how it differs from its type; what a unit failed by is `attempt`'s.
void calibrate_units(const CalibrateArguments& arguments, const std::vector<CalibrationTask>& tasks,
                     const Attempt& attempt);

}  // namespace spoolflow::apps
