/// Compiled for AVX-512 where the compiler can (CMakeLists.txt); called only where the processor can.
#if defined(__AVX512DQ__)
#include "spoolflow/estimation/packs/group_kernel.hpp"

namespace spoolflow::estimation::packs {

using Register = simd::native_simd<double>;
const GroupSteps observer_group_avx512 = group_steps_of<ObserversTogether<Register, 1>>();
const GroupSteps whole_valve_group_avx512 = group_steps_of<WholeValvesTogether<Register, 1>>();

}  // namespace spoolflow::estimation::packs
#else
#include "spoolflow/estimation/packs/group_steps.hpp"

namespace spoolflow::estimation::packs {

const GroupSteps observer_group_avx512{};
const GroupSteps whole_valve_group_avx512{};

}  // namespace spoolflow::estimation::packs
#endif
