#pragma once
/// The full soft sensor (paper Fig 3): actuator, spring, friction fed back from the estimated flow, metering edge by
/// temperature, and the pressure difference as the hidden state.
#include <cmath>
#include <type_traits>

#include "spoolflow/sensor/actuator.hpp"
#include "spoolflow/sensor/friction.hpp"
#include "spoolflow/sensor/metering_edge.hpp"
#include "spoolflow/sensor/position_track.hpp"
#include "spoolflow/sensor/pressure_difference.hpp"
#include "spoolflow/sensor/sample.hpp"
#include "spoolflow/sensor/spring.hpp"

namespace spoolflow::sensor {

/// How sure the observer may be, beyond what its parts tell.
template <class T>
struct BandParameters {
  T friction_share{};    ///< standard deviation of sliding friction about its map, as a share of it
  T force_residual_N{};  ///< standard deviation of all maps together
  T flow_residual_m3_per_s{};
  T coverage_factor{};  ///< standard deviations in the 95 % band
  T force_share{};      ///< how much of the force errors that the parts tell the band counts while the spool slides
  T rest_share{};       ///< the same at rest
  T tolerance_N{};      ///< standard deviation of friction told by the pre-sliding displacement
  T creep_per_s{};      ///< growth of that tolerance with the time at rest, as a share of it
  T unseen_factor{};    ///< standard deviation of unseen changes of pressure over the liveliest drift, at liveliness 1
  T reference_lag_s{};  ///< of the flow meter that the band is held against: it still reads what has been
};

/// Everything about one valve that the observer needs; trivially copyable, fit for constexpr flash.
template <class T>
struct ObserverParameters {
  ActuatorParameters<T> actuator;
  Spring<T> spring;
  MeteringEdge<T> edge;
  PositionSensor<T> position_sensor;
  FrictionParameters<T> friction;
  PressureParameters<T> pressure;
  BandParameters<T> band;
  T closed_below_m{};
  T largest_current_A{};
};

template <class T>
struct ObserverState {
  ActuatorState<T> actuator;
  PositionState<T> position;
  FrictionState<T> friction;
  PressureState<T> pressure;
  T oil_temperature_K{};  ///< smoothed
  T flow_m3_per_s{};      ///< as answered
  T metered_m3_per_s{};   ///< as a flow meter with its lag would read it
  T force_noise_N{};      ///< one standard deviation of all forces together, as the parts tell it
  Truth<T> started{};
  Estimate<T> last{};
};

static_assert(std::is_trivially_copyable_v<ObserverParameters<float>>);
static_assert(std::is_trivially_copyable_v<ObserverState<float>>);
static_assert(sizeof(ObserverState<float>) < 2048);

namespace detail {

/// A slip is over in a few milliseconds, and so are most of its swings of flow: the answer follows them at this pace.
inline constexpr double slip_smoothing_s = 0.02;

template <class T>
constexpr void start(const ObserverParameters<T>& valve, ObserverState<T>& state, const Sample<T>& sample) {
  const T highest_Pa = valve.edge.highest_pressure_difference_Pa();
  state.started = Truth<T>(true);
  state.oil_temperature_K =
      select(is_number(sample.oil_temperature_K), sample.oil_temperature_K, valve.edge.temperature_K.at(1));
  state.pressure.pressure_difference_Pa = T(0.5) * highest_Pa;
  state.pressure.variance_Pa2 = squared(T(0.3) * highest_Pa);
  state.pressure.liveliness = valve.pressure.first_liveliness;
  state.pressure.doubt_Pa2 =
      state.pressure.variance_Pa2 / squared(valve.band.unseen_factor * valve.pressure.first_liveliness);
  state.pressure.friction_ratio = valve.friction.operation_ratio;
  state.pressure.ratio_variance = squared(valve.pressure.ratio_deviation);
  state.pressure.innovation = T(usual_innovation);
}

/// The oil warms slowly and its sensor is noisy.
template <class T>
constexpr void follow_temperature(ObserverState<T>& state, const Sample<T>& sample) {
  const T smoothing_s = T(2);
  state.oil_temperature_K += select(
      is_number(sample.oil_temperature_K),
      (sample.oil_temperature_K - state.oil_temperature_K) * smaller(sample.time_step_s / smoothing_s, T(1)), T(0));
}

}  // namespace detail

/// One sample through the chain of paper Fig 3. Needs current and position, and a time that does not run backwards:
/// otherwise the last answer is held. A missing oil temperature is held, a missing voltage means a force map by current
/// alone. The answer stays in the state.
template <class T>
constexpr const Estimate<T>& step(const ObserverParameters<T>& valve, ObserverState<T>& state,
                                  const Sample<T>& sample) {
  if constexpr (one_valve<T>) {
    if (const Status held = unusable(sample); held != Status::none) {
      state.last.status = held;
      return state.last;
    }
  }
  in_valves(!state.started, state, [&] { detail::start(valve, state, sample); });
  detail::follow_temperature(state, sample);
  const T dt = sample.time_step_s;

  // Spool position, free of drift and faults, and what the spool does.
  const PositionPoint<T> position =
      step(valve.position_sensor, state.position, dt, sample.position_m, state.oil_temperature_K);

  // Actuator: from coil current and voltage to the force on the spool.
  Sample<T> actuated = sample;
  actuated.position_m = position.position_m;
  const ActuatorEstimate<T> actuator = step(valve.actuator, state.actuator, actuated);
  const T spring_N = valve.spring.at(position.position_m).value;
  const T net_N = actuator.magnetic_force_N - spring_N;  // carries flow force and friction; paper (1)

  // Metering edge and friction at the believed pressure difference.
  PressureState<T>& pressure = state.pressure;
  const EdgePoint<T> edge =
      valve.edge.at(state.oil_temperature_K, pressure.pressure_difference_Pa, position.position_m);
  const T spool_N = pressure.friction_ratio * edge.friction_N;
  const T spool_per_pressure_N_Pa = pressure.friction_ratio * edge.friction_per_pressure_N_Pa;
  const T armature_N = pressure.friction_ratio * actuator.friction_half_width_N;
  const FrictionBounds<T> bounds = friction_bounds(valve.friction, state.friction, spool_N, armature_N);
  const T apparent_friction_N = net_N - edge.flow_force_N;
  const FrictionInterval<T> resting =
      step(valve.friction, state.friction, bounds, valve.position_sensor, position, apparent_friction_N, dt);

  // Pressure difference: every newton tells while the spool slides; at rest only what friction cannot explain.
  const Truth<T> closed = position.position_m < valve.closed_below_m;
  const Truth<T> sliding = is(position.motion, Motion::opening) || is(position.motion, Motion::closing);
  const T direction = select(position.travel_m > T(0), T(1), T(-1));
  const T friction_N =
      select(sliding, direction * bounds.sliding_N, limited(apparent_friction_N, resting.lower_N, resting.upper_N));
  const T least_slope = T(1e-8);
  const T slope = larger(edge.flow_force_per_pressure_N_Pa, least_slope);
  const T force_noise_N = sqrt(squared(valve.band.force_residual_N) + squared(actuator.uncertainty_N) +
                               squared(valve.band.friction_share * bounds.sliding_N));
  state.force_noise_N = force_noise_N;
  const T highest_Pa = valve.edge.highest_pressure_difference_Pa();
  in_valves(closed, pressure, [&] { expect_change(valve.pressure, pressure); });
  in_valves(sliding, pressure, [&] {
    drift(valve.pressure, pressure, dt, highest_Pa);
    forget_ratio(valve.pressure, pressure, valve.friction.operation_ratio, dt);
  });
  in_valves(!sliding, pressure, [&] { drift_unseen(valve.pressure, pressure, dt, highest_Pa); });
  // The coil is slow enough to be followed in those samples that have least else to do.
  in_valves(!sliding && resting.breakaway_N == T(0), state.actuator,
            [&] { follow_coil(valve.actuator, state.actuator, sample); });
  const T surprise_N = apparent_friction_N - friction_N;
  in_valves(!closed && sliding, pressure, [&] {
    const T whole_slope = larger(slope + direction * spool_per_pressure_N_Pa, T(0.3) * slope);
    const T ratio_slope_N = direction * (edge.friction_N + actuator.friction_half_width_N);
    in_valves(dt > T(0), pressure, [&] {
      update_sliding(valve.pressure, pressure, {surprise_N, whole_slope, ratio_slope_N, force_noise_N}, dt);
    });
    in_valves(settled(pressure, slope, force_noise_N), pressure,
              [&] { learn_liveliness(valve.pressure, pressure, force_noise_N / slope); });
  });
  const Truth<T> breaks =
      !closed && !sliding && resting.breakaway_N != T(0) && resting.rested_s > T(0.03) + T(0.5) * dt;
  in_valves(breaks, pressure, [&] {
    const T aged = ageing(valve.friction, resting.rested_s);
    const T expected_N = direction * (aged * spool_N + armature_N);
    const T noise_N = sqrt(squared(force_noise_N) + squared(valve.friction.breakaway_share * expected_N));
    const T whole_slope = larger(slope + direction * aged * spool_per_pressure_N_Pa, T(0.3) * slope);
    const T ratio_slope_N = direction * (aged * edge.friction_N + actuator.friction_half_width_N);
    update_breakaway(pressure, {resting.breakaway_N - expected_N, whole_slope, ratio_slope_N, noise_N});
  });
  const Truth<T> yields = !closed && !sliding && !breaks && is(position.motion, Motion::rest) && surprise_N != T(0);
  in_valves(yields, pressure, [&] {
    const T left_N = yield(valve.pressure, pressure, {surprise_N, slope, T(0), valve.friction.tolerance_N}, dt);
    state.friction.gauge_N += select(yields && magnitude(apparent_friction_N) < bounds.sticking_N, left_N, T(0));
  });
  pressure.pressure_difference_Pa = limited(pressure.pressure_difference_Pa, T(0), highest_Pa);

  // Flow rate with its band.
  Estimate<T>& out = state.last;
  const T root = sqrt(pressure.pressure_difference_Pa);
  const T flow_m3_per_s = larger(edge.conductance * root, T(0));
  const T following =
      select(is(position.motion, Motion::transient), smaller(dt / (T(detail::slip_smoothing_s) + dt), T(1)), T(1));
  const T change_m3_per_s = following * (flow_m3_per_s - state.flow_m3_per_s);
  state.flow_m3_per_s += change_m3_per_s;
  out.flow_m3_per_s = state.flow_m3_per_s;
  state.metered_m3_per_s +=
      smaller(dt / (valve.band.reference_lag_s + dt), T(1)) * (out.flow_m3_per_s - state.metered_m3_per_s);
  const T share = select(sliding, valve.band.force_share, valve.band.rest_share);
  const T unseen_Pa = unseen_change_Pa(pressure, valve.band.unseen_factor);
  const T deviation_Pa = valve.band.coverage_factor * band_factor(pressure) *
                         sqrt(squared(unseen_Pa) + squared(share * force_noise_N / slope));
  const T tolerance_N = valve.band.tolerance_N * (T(1) + valve.band.creep_per_s * state.friction.rest_s);
  const T certain_Pa = valve.band.coverage_factor * (valve.band.force_share * force_noise_N + tolerance_N) / slope;
  T below_Pa = deviation_Pa;
  T above_Pa = deviation_Pa;
  const Truth<T> bounded = !sliding && !closed;
  if (any(bounded)) {
    below_Pa = select(
        bounded, smaller(below_Pa, larger(resting.upper_N - apparent_friction_N, T(0)) / slope + certain_Pa), below_Pa);
    above_Pa = select(
        bounded, smaller(above_Pa, larger(apparent_friction_N - resting.lower_N, T(0)) / slope + certain_Pa), above_Pa);
  }
  const T residual = T(1.2) * valve.band.flow_residual_m3_per_s;
  const T lag_m3_per_s = state.metered_m3_per_s - out.flow_m3_per_s;
  out.flow_lower_m3_per_s =
      smaller(edge.conductance * sqrt(larger(pressure.pressure_difference_Pa - below_Pa, T(0))), out.flow_m3_per_s) -
      residual + smaller(lag_m3_per_s, T(0));
  out.flow_upper_m3_per_s =
      larger(edge.conductance * sqrt(smaller(pressure.pressure_difference_Pa + above_Pa, highest_Pa)),
             out.flow_m3_per_s) +
      residual + larger(lag_m3_per_s, T(0));
  out.pressure_difference_Pa = pressure.pressure_difference_Pa;
  out.magnetic_force_N = actuator.magnetic_force_N;
  out.spring_force_N = spring_N;
  out.flow_force_N = edge.flow_force_N;
  out.friction_force_N = friction_N;
  typename ScalarTypes<T>::StatusWord status{};
  mark(status, closed, Status::closed);
  mark(status, !sliding, Status::spool_at_rest);
  mark(status, !actuator.inside_map, Status::outside_force_map);
  mark(status, !edge.inside && !closed, Status::outside_flow_force_map);
  mark(status, !edge.temperature_inside, Status::outside_temperature);
  mark(status, sample.current_A > valve.largest_current_A, Status::current_saturated);
  mark(status, position.fault, Status::position_fault);
  mark(status, state.actuator.coil_resistance.implausible, Status::coil_fault);
  out.status = status;
  return out;
}

}  // namespace spoolflow::sensor
