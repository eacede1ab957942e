/// Compiled for AVX-512 where the compiler can (CMakeLists.txt); called only where the processor can.
#if defined(__AVX512DQ__)
#include "spoolflow/estimation/batch/batch_kernel.hpp"

namespace spoolflow::estimation::batch {

const BatchSteps condensed_avx512 = condensed_steps;
const BatchSteps observer_avx512 = observer_steps;
const BatchSteps whole_condensed_avx512 = whole_condensed_steps;
const BatchSteps whole_valve_avx512 = whole_valve_steps;

}  // namespace spoolflow::estimation::batch
#else
#include "spoolflow/estimation/batch/batch_steps.hpp"

namespace spoolflow::estimation::batch {

const BatchSteps condensed_avx512{};
const BatchSteps observer_avx512{};
const BatchSteps whole_condensed_avx512{};
const BatchSteps whole_valve_avx512{};

}  // namespace spoolflow::estimation::batch
#endif
