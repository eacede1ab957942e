#pragma once
/// A coil whose flux linkage falls with the opening and bends with the current.
#include <cmath>

#include "spoolflow/plausibility/signals/known_coil.hpp"

namespace spoolflow::plausibility {

inline constexpr double resistance_Ohm = 3;

inline double flux_Wb(double current_A, double position_m) {
  return 0.2 * std::tanh(0.6 * current_A) * (1 - 50 * position_m);
}

inline const KnownCoil coil{resistance_Ohm, flux_Wb};

}  // namespace spoolflow::plausibility
