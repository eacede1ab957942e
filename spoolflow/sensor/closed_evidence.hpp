#pragma once
/// Where the spool covers the metering edge no force shows the pressure difference, and nothing flows that would. The
/// forces show whether it can be there.
#include "spoolflow/sensor/force_balance.hpp"
#include "spoolflow/sensor/pressure_difference.hpp"
#include "spoolflow/sensor/signals/position_track.hpp"

namespace spoolflow::sensor {

/// No spool rests where the magnetic force exceeds the spring by more than so many times what friction, and one
/// standard deviation of all forces, hold: dirt doubles a break-away.
inline constexpr double unmoved_factor = 3;
/// After so long [s] it is the position that is wrong: a spool that breaks away uncovers the edge sooner.
inline constexpr double longest_unmoved_s = 0.05;

/// Behind a closed valve the supply may do what it likes, however steady it has been.
template <class T>
constexpr void expect_change(const PressureParameters<T>& pressure, PressureState<T>& state) {
  state.process_noise = larger(state.process_noise, pressure.first_process_noise);
}

/// Forces [N] on a spool that covers the edge by its position.
template <class T>
struct ClosedForces {
  T residual_N;  ///< magnetic force less spring and flow force
  T spring_N;
  T held_N;  ///< by friction at rest, and one standard deviation of all forces
  T side;    ///< see PositionPoint
};
template <class T>
SPOOLFLOW_INLINE constexpr ClosedForces<T> closed_forces(const ForceBalance<T>& balance, T environment_N,
                                                         const PositionPoint<T>& position) {
  return {balance.residual_force_N, balance.spring_N,
          balance.bounds.sticking_N + balance.half_swing_N + balance.noise_N + environment_N, position.side};
}

/// The way in which these forces move any spool: 1 opens, -1 opens the other direction, 0 they may hold it. Of a whole
/// valve the other solenoid may be the stronger one; it works against a spring that is the image of this one.
template <class T>
constexpr T way_of(const ClosedForces<T>& forces) {
  const T most_N = T(unmoved_factor) * forces.held_N;
  if (forces.residual_N > most_N) return T(1);
  return -forces.residual_N - T(2) * forces.spring_N > most_N ? T(-1) : T(0);
}

}  // namespace spoolflow::sensor
