/// Compiled for AVX2 where the compiler can (CMakeLists.txt); called only where the processor can.
#if defined(__AVX2__)
#include "spoolflow/rig/plants/plant_kernel.hpp"

namespace spoolflow::rig {

const PlantSteps plant_avx2 = plant_steps_of<4>();

}  // namespace spoolflow::rig
#else
#include "spoolflow/rig/plants/plant_steps.hpp"

namespace spoolflow::rig {

const PlantSteps plant_avx2{};

}  // namespace spoolflow::rig
#endif
