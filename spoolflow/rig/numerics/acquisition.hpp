#pragma once
/// What every channel of the recorder does to its signal: a first-order lag and the steps of its converter.
#include <cmath>
#include <cstdint>

#include "spoolflow/rig/numerics/elementary_functions.hpp"

namespace spoolflow::rig {

/// A first-order lag's output after `dt_s` at constant input; exact for any step length. No lag at time constant 0.
inline double lagged(double output, double input, double dt_s, double time_constant_s) {
  return time_constant_s > 0 ? input + (output - input) * exponential(-dt_s / time_constant_s) : input;
}

/// What a first-order lag leaves of a difference over a step, kept until step or time constant change.
struct LagMemory {
  double dt_s = 0, time_constant_s = 0, left = 0;
};

/// As lagged() without the memory.
inline double lagged(double output, double input, double dt_s, double time_constant_s, LagMemory& memory) {
  if (!(time_constant_s > 0)) return input;
  if (dt_s != memory.dt_s || time_constant_s != memory.time_constant_s) {
    memory = {dt_s, time_constant_s, exponential(-dt_s / time_constant_s)};
  }
  return input + (output - input) * memory.left;
}

/// As std::round, without a call of the library: halves go away from zero, and a zero keeps the sign.
inline double rounded(double value) {
  constexpr double all_whole = 0x1p52;  // from here on
  if (!(std::abs(value) < all_whole)) return value;
  const auto towards_zero = static_cast<double>(static_cast<std::int64_t>(value));
  const double rest = value - towards_zero;
  return std::copysign(towards_zero + (rest >= 0.5 ? 1.0 : rest <= -0.5 ? -1.0 : 0.0), value);
}

/// The nearest multiple of `resolution`; unchanged at resolution 0.
inline double quantised(double value, double resolution) {
  return resolution > 0 ? resolution * rounded(value / resolution) : value;
}

}  // namespace spoolflow::rig
