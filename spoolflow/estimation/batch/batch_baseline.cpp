#include "spoolflow/estimation/batch/batch_kernel.hpp"

namespace spoolflow::estimation::batch {

const BatchSteps condensed_baseline = condensed_steps;
const BatchSteps observer_baseline = observer_steps;

}  // namespace spoolflow::estimation::batch
