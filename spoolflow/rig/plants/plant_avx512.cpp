/// Compiled for AVX-512 where the compiler can (CMakeLists.txt); called only where the processor can.
#if defined(__AVX512DQ__)
#include "spoolflow/rig/plants/plant_kernel.hpp"

namespace spoolflow::rig {

const PlantSteps plant_avx512 = plant_steps_of<8>();

}  // namespace spoolflow::rig
#else
#include "spoolflow/rig/plants/plant_steps.hpp"

namespace spoolflow::rig {

const PlantSteps plant_avx512{};

}  // namespace spoolflow::rig
#endif
