#pragma once
/// Contact of the push rod with the pole at either end of the travel (Hunt and Crossley 1975):
///
///     F = k d (1 + c dd/dt) >= 0,   d the depth beyond the end stop
#include "spoolflow/rig/numerics/scalar.hpp"
#include "spoolflow/rig/plant/spool.hpp"

namespace spoolflow::rig {

template <class Scalar>
struct EndStopForceOf {
  Scalar force_N;  ///< towards -x
  Scalar stiffness_N_per_m;
  Scalar damping_N_s_per_m;
};

template <class Scalar>
inline EndStopForceOf<Scalar> end_stop_force(const SpoolOf<Scalar>& spool, Scalar position_m, Scalar velocity_m_per_s) {
  const Scalar depth = magnitude(position_m) - spool.end_stop_m;
  const Mask<Scalar> touches = !(depth <= 0.0);
  if (!any(touches)) return {0.0, 0.0, 0.0};
  const Scalar side = select(position_m > 0.0, Scalar(1.0), Scalar(-1.0));
  const Scalar stiffness = spool.end_stop_stiffness_N_per_m;
  const Scalar push =
      stiffness * depth * larger(Scalar(0.0), 1.0 + spool.end_stop_damping_s_per_m * side * velocity_m_per_s);
  return {select(touches, side * push, Scalar(0.0)), select(touches, stiffness, Scalar(0.0)),
          select(touches, stiffness * depth * spool.end_stop_damping_s_per_m, Scalar(0.0))};
}

}  // namespace spoolflow::rig
