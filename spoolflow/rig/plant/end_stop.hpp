#pragma once
/// Contact of the push rod with the pole at either end of the travel (Hunt and Crossley 1975):
///
///     F = k d (1 + c dd/dt) >= 0,   d the depth beyond the end stop
#include <algorithm>
#include <cmath>

#include "spoolflow/rig/plant/spool.hpp"

namespace spoolflow::rig {

struct EndStopForce {
  double force_N;  ///< towards -x
  double stiffness_N_per_m;
  double damping_N_s_per_m;
};

inline EndStopForce end_stop_force(const Spool& spool, double position_m, double velocity_m_per_s) {
  const double depth = std::abs(position_m) - spool.end_stop_m;
  if (depth <= 0.0) return {0.0, 0.0, 0.0};
  const double side = position_m > 0.0 ? 1.0 : -1.0;
  const double stiffness = spool.end_stop_stiffness_N_per_m;
  const double push = stiffness * depth * std::max(0.0, 1.0 + spool.end_stop_damping_s_per_m * side * velocity_m_per_s);
  return {side * push, stiffness, stiffness * depth * spool.end_stop_damping_s_per_m};
}

}  // namespace spoolflow::rig
