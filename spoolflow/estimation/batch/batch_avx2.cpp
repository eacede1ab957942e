/// Compiled for AVX2 where the compiler can (CMakeLists.txt); called only where the processor can.
#if defined(__AVX2__)
#include "spoolflow/estimation/batch/batch_kernel.hpp"

namespace spoolflow::estimation::batch {

const BatchSteps condensed_avx2 = condensed_steps;
const BatchSteps observer_avx2 = observer_steps;
const BatchSteps whole_condensed_avx2 = whole_condensed_steps;
const BatchSteps whole_valve_avx2 = whole_valve_steps;

}  // namespace spoolflow::estimation::batch
#else
#include "spoolflow/estimation/batch/batch_steps.hpp"

namespace spoolflow::estimation::batch {

const BatchSteps condensed_avx2{};
const BatchSteps observer_avx2{};
const BatchSteps whole_condensed_avx2{};
const BatchSteps whole_valve_avx2{};

}  // namespace spoolflow::estimation::batch
#endif
