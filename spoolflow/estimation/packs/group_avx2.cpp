/// Compiled for AVX2 where the compiler can (CMakeLists.txt); called only where the processor can.
#if defined(__AVX2__)
#include "spoolflow/estimation/packs/group_kernel.hpp"

namespace spoolflow::estimation::packs {

using Register = simd::native_simd<double>;
const GroupSteps observer_group_avx2 = group_steps_of<ObserversTogether<Register, 1>>();
const GroupSteps whole_valve_group_avx2 = group_steps_of<WholeValvesTogether<Register, 1>>();

}  // namespace spoolflow::estimation::packs
#else
#include "spoolflow/estimation/packs/group_steps.hpp"

namespace spoolflow::estimation::packs {

const GroupSteps observer_group_avx2{};
const GroupSteps whole_valve_group_avx2{};

}  // namespace spoolflow::estimation::packs
#endif
