/// Compiled for AVX2 where the compiler can (CMakeLists.txt); called only where the processor can.
#if defined(__AVX2__)
#include "spoolflow/validation/batch_kernel.hpp"

namespace spoolflow::validation {

const BatchSteps condensed_avx2 = condensed_steps;
const BatchSteps observer_avx2 = observer_steps;

}  // namespace spoolflow::validation
#else
#include "spoolflow/validation/batch_steps.hpp"

namespace spoolflow::validation {

const BatchSteps condensed_avx2{};
const BatchSteps observer_avx2{};

}  // namespace spoolflow::validation
#endif
