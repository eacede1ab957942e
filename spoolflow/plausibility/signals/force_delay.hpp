#pragma once
/// A load cell whose amplifier shows the solenoid's force late: the force of a held armature follows the flux of its
/// coil, which voltage and current show at once.
#include <string>

#include "spoolflow/recording/recording.hpp"

namespace spoolflow::plausibility {

/// One sentence where the rate of the force follows that of the coil's energy, current times the voltage beside the
/// resistance, by 1.5 ms or more, or comes so much before it; else empty. Delay and first-order lag with which the two
/// correlate best, over stretches of one test at a held position whose samples are no more than 0.5 ms apart. Sound
/// recordings have 0.1 ms and a correlation of 0.99. Reads time, test, position, current, voltage and force.
[[nodiscard]] std::string late_force(const recording::Recording& run);

}  // namespace spoolflow::plausibility
