#include "spoolflow/estimation/batch/batch_kernel.hpp"

namespace spoolflow::estimation::batch {

const BatchSteps condensed_baseline = condensed_steps;
const BatchSteps observer_baseline = observer_steps;
const BatchSteps whole_condensed_baseline = whole_condensed_steps;
const BatchSteps whole_valve_baseline = whole_valve_steps;

}  // namespace spoolflow::estimation::batch
