#include "spoolflow/estimation/batch/batch_kernel.hpp"

namespace spoolflow::estimation::batch {

using Steps = StepsIn<packs::simd::native_simd<float>>;
const BatchSteps condensed_baseline = Steps::condensed;
const BatchSteps observer_baseline = Steps::observer;
const BatchSteps whole_condensed_baseline = Steps::whole_condensed;
const BatchSteps whole_valve_baseline = Steps::whole_valve;

}  // namespace spoolflow::estimation::batch
