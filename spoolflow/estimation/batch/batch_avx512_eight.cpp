/// Eight valves a register with AVX-512's masks and twice as many registers as AVX2 has: what observers gain by, and
/// condensed sensors do not. Compiled where the compiler can (CMakeLists.txt); called only where the processor can.
#if defined(__AVX512VL__)
#include "spoolflow/estimation/batch/batch_kernel.hpp"

namespace spoolflow::estimation::batch {

using Steps = StepsIn<packs::simd::simd<float, packs::simd::simd_abi::deduce_t<float, 8>>>;
const BatchSteps observer_avx512_eight = Steps::observer;
const BatchSteps whole_valve_avx512_eight = Steps::whole_valve;

}  // namespace spoolflow::estimation::batch
#else
#include "spoolflow/estimation/batch/batch_steps.hpp"

namespace spoolflow::estimation::batch {

const BatchSteps observer_avx512_eight{};
const BatchSteps whole_valve_avx512_eight{};

}  // namespace spoolflow::estimation::batch
#endif
