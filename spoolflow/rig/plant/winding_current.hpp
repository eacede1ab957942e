#pragma once
#include "spoolflow/rig/plant/solenoid.hpp"

namespace spoolflow::rig {

/// Current through the winding's terminals [A]: what the leakage inductance carries beyond the main flux.
inline double winding_current_A(const Solenoid& solenoid, const SolenoidState& state) {
  const double turns = active_turns(solenoid.coil);
  return (state.flux_linkage_Wb - turns * state.flux_Wb) / (turns * turns * solenoid.circuit.leakage_permeance_H);
}

}  // namespace spoolflow::rig
