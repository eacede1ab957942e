#include "spoolflow/validation/batch_kernel.hpp"

namespace spoolflow::validation {

const BatchSteps condensed_baseline = condensed_steps;
const BatchSteps observer_baseline = observer_steps;

}  // namespace spoolflow::validation
