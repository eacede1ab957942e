/// Compiled for AVX2 where the compiler can (CMakeLists.txt); called only where the processor can.
#if defined(__AVX2__)
#include "spoolflow/estimation/batch/batch_kernel.hpp"

namespace spoolflow::estimation::batch {

using Steps = StepsIn<packs::simd::native_simd<float>>;
const BatchSteps condensed_avx2 = Steps::condensed;
const BatchSteps observer_avx2 = Steps::observer;
const BatchSteps whole_condensed_avx2 = Steps::whole_condensed;
const BatchSteps whole_valve_avx2 = Steps::whole_valve;

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
