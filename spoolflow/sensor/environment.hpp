#pragma once
/// What the machine around the valve leaves unknown that the bench knew, as standard uncertainties, and what they mean
/// for the band. All zero is the bench. They are common to many samples: no filter averages them away, so that they
/// enter the band and not the filter.
#include "spoolflow/sensor/force_balance.hpp"

namespace spoolflow::sensor {

/// Shares of the conductance are taken of no less than this share of the widest opening's.
inline constexpr double least_conductance_share = 0.01;

/// Whether nothing is left open beside what the flow itself is widened by.
template <class T>
[[gnu::always_inline]] constexpr bool is_bench(const Environment<T>& environment) {
  return !(environment.position_m + environment.position_share + environment.current_share + environment.force_N +
               environment.oil_temperature_K + environment.friction_share + environment.ripple_Pa >
           T(0));
}

/// What an edge elsewhere, or of other oil, does to the flow rate that is told from a force [N]: as the force that would
/// change it alike. An edge with more flow force is thought to have more pressure difference than it has; one with more
/// conductance passes more.
template <class T>
constexpr T edge_effect_N(const EdgePoint<T>& edge, const EdgePoint<T>& other, T pressure_difference_Pa, T least) {
  const T conductance_share = (other.conductance - edge.conductance) / larger(edge.conductance, least);
  return T(2) * conductance_share * edge.flow_force_per_pressure_N_Pa * pressure_difference_Pa -
         (other.flow_force_N - edge.flow_force_N);
}

/// What the environment leaves open of the force that the pressure difference is told from [N], one standard deviation.
/// What a position error does to force and conductance belongs together: the one takes off the other.
template <class T>
[[gnu::noinline]] constexpr T environment_N(const ObserverParameters<T>& valve, const ObserverState<T>& state,
                                            const ForceBalance<T>& balance, T position_m, T current_A) {
  const Environment<T>& environment = valve.environment;
  const MeteringEdge<T>& edge = valve.edge;
  const T believed_Pa = state.pressure.pressure_difference_Pa;
  const T least = T(least_conductance_share) * edge.conductance.node(0, 1, edge_positions - 1);
  const T off_m = sqrt(squared(environment.position_m) + squared(environment.position_share * position_m));
  const EdgePoint<T> there = edge.at(state.oil_temperature_K, believed_Pa, position_m + off_m);
  const T stiffness_N_per_m = valve.spring.at(position_m).slope - balance.actuator.force_per_position_N_per_m;
  const T moved_N = edge_effect_N(balance.edge, there, believed_Pa, least) - stiffness_N_per_m * off_m;
  const EdgePoint<T> warmer = edge.at(state.oil_temperature_K + environment.oil_temperature_K, believed_Pa, position_m);
  const T warmer_N = edge_effect_N(balance.edge, warmer, believed_Pa, least);
  const T current_N = environment.current_share * current_A * balance.actuator.force_per_current_N_per_A;
  const T ripple_N = balance.edge.flow_force_per_pressure_N_Pa * environment.ripple_Pa;
  const T freed_N = smaller(ripple_N, balance.bounds.sliding_N);
  const T friction_N = environment.friction_share * (balance.spool_friction_N + balance.armature_friction_N);
  return sqrt(squared(environment.force_N) + squared(current_N) + squared(moved_N) + squared(warmer_N) +
              squared(ripple_N) + squared(freed_N) + squared(friction_N));
}

}  // namespace spoolflow::sensor
