#include "spoolflow/validation/batch_kernel.hpp"

namespace spoolflow::validation {

const BatchSteps condensed_baseline = condensed_steps;

}  // namespace spoolflow::validation
