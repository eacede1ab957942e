#pragma once
/// The paper's condensed sensor (section 3, Fig 4): two averaged maps and the springs.
#include <type_traits>

#include "spoolflow/sensor/flow_rate.hpp"
#include "spoolflow/sensor/magnetic_force.hpp"
#include "spoolflow/sensor/sample.hpp"
#include "spoolflow/sensor/spring.hpp"
#include "spoolflow/sensor/uncertainty.hpp"

namespace spoolflow::sensor {

/// Everything about one valve that the condensed sensor needs; trivially copyable, fit for constexpr flash.
template <class T>
struct CondensedParameters {
  MagneticForce<T> magnetic_force;
  Spring<T> spring;
  FlowRate<T> flow_rate;
  Curve<T, spring_positions> friction_half_width_N;  ///< over position [m]: what averaging both directions removed
  T closed_below_m{};                                ///< positions at which no flow was measured
  T force_residual_N{};                              ///< standard deviation of the averaged forces about the maps
  T flow_residual_m3_per_s{};                        ///< standard deviation of the measured flow about the map
};

/// The condensed sensor remembers only its last answer, which it holds where a sample is missing.
template <class T>
struct CondensedState {
  Estimate<T> last{};
};

static_assert(std::is_trivially_copyable_v<CondensedParameters<float>>);
static_assert(std::is_trivially_copyable_v<CondensedState<float>>);

/// One sample through the chain: magnetic force, spring, flow force, flow rate. Friction, hysteresis and inertia are
/// left out (paper section 3) and stand in the band instead. Needs current and position, and a time that does not run
/// backwards: otherwise the last answer is held. Other inputs are not read.
template <class T>
constexpr Estimate<T> step(const CondensedParameters<T>& valve, CondensedState<T>& state, const Sample<T>& sample) {
  const auto held = unusable(sample);
  const Estimate<T> before = state.last;
  if constexpr (one_valve<T>) {
    if (held != Status::none) {
      state.last.status = held;
      return state.last;
    }
  }
  Estimate<T>& out = state.last;
  const MapPoint<T> magnetic_force = valve.magnetic_force.at(sample.current_A, sample.position_m);
  out.magnetic_force_N = magnetic_force.value;
  out.spring_force_N = valve.spring.at(sample.position_m).value;
  out.flow_force_N = out.magnetic_force_N - out.spring_force_N;  // paper (1) without friction and inertia

  const FlowRatePosition<T> position = valve.flow_rate.located(sample.position_m);
  const FlowRatePoint<T> flow = valve.flow_rate.at(out.flow_force_N, position);
  out.flow_m3_per_s = flow.flow_m3_per_s;
  out.pressure_difference_Pa = flow.pressure_difference_Pa;

  // Friction and hysteresis are bounds, the residuals are random: the first add, the second are covered twice over.
  const T systematic_N = valve.friction_half_width_N.at(sample.position_m).value +
                         valve.magnetic_force.hysteresis_half_width_N.at(sample.current_A).value;
  const FlowBand<T> band = flow_band(valve.flow_rate, position, out.flow_force_N,
                                     systematic_N + T(2) * valve.force_residual_N, T(2) * valve.flow_residual_m3_per_s);
  out.flow_lower_m3_per_s = band.lower_m3_per_s;
  out.flow_upper_m3_per_s = band.upper_m3_per_s;

  const Truth<T> closed = sample.position_m < valve.closed_below_m;
  out.status = when(closed, Status::closed) | when(!magnetic_force.inside, Status::outside_force_map) |
               when(!flow.inside && !closed, Status::outside_flow_force_map);
  if constexpr (!one_valve<T>) hold(held, before, out);
  return out;
}

}  // namespace spoolflow::sensor
