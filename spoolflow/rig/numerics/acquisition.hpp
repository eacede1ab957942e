#pragma once
/// What every channel of the recorder does to its signal: a first-order lag and the steps of its converter.
#include <cmath>

#include "spoolflow/rig/numerics/elementary_functions.hpp"

namespace spoolflow::rig {

/// A first-order lag's output after `dt_s` at constant input; exact for any step length. No lag at time constant 0.
inline double lagged(double output, double input, double dt_s, double time_constant_s) {
  return time_constant_s > 0 ? input + (output - input) * exponential(-dt_s / time_constant_s) : input;
}

/// The nearest multiple of `resolution`; unchanged at resolution 0.
inline double quantised(double value, double resolution) {
  return resolution > 0 ? resolution * std::round(value / resolution) : value;
}

}  // namespace spoolflow::rig
