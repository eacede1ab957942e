#pragma once
/// The 95 % band: what the errors of the forces and unobserved changes of the supply leave open of the pressure
/// difference, cut off where friction at rest would lie outside its bounds, and what that makes of the flow rate.
///
/// What the machine around the valve leaves open (Environment) is common to many samples: no filter averages it away,
/// so that it enters the band and not the filter.
#include "spoolflow/sensor/basis/compiler.hpp"
#include "spoolflow/sensor/force_balance.hpp"

namespace spoolflow::sensor {

/// Shares of the conductance are taken of no less than this share of the widest opening's.
inline constexpr double least_conductance_share = 0.01;
/// Shares divide by no smaller conductance [m3/s/Pa(1/2)].
inline constexpr double vanishing_conductance = 1e-12;
/// More than this [N] leaves nothing known of the pressure difference.
inline constexpr double most_environment_N = 1e5;

/// Whether nothing is left open beside what the flow itself is widened by.
template <class T>
SPOOLFLOW_INLINE constexpr bool is_bench(const Environment<T>& environment) {
  return !(environment.position_m + environment.position_share + environment.current_share + environment.force_N +
               environment.oil_temperature_K + environment.friction_share + environment.dithered_loop_A +
               environment.ripple_Pa >
           T(0));
}

/// What an edge elsewhere, or of other oil, does to the flow rate that is computed from a force [N]: as the force that
/// would change it alike. Where the edge has more flow force than the model, the pressure difference is overestimated;
/// one with more conductance passes more.
template <class T>
constexpr T edge_effect_N(const EdgePoint<T>& edge, const EdgePoint<T>& other, T pressure_difference_Pa, T least) {
  const T conductance_share = (other.conductance - edge.conductance) / larger(edge.conductance, least);
  return T(2) * limited(conductance_share, T(-1), T(1)) * edge.flow_force_per_pressure_N_Pa * pressure_difference_Pa -
         (other.flow_force_N - edge.flow_force_N);
}

/// Where the valve works.
template <class T>
struct OperatingPoint {
  Cell<T> oil_layer;         ///< of its temperature
  T pressure_difference_Pa;  ///< estimated
  T position_m;
  T current_A;
  T breakaway_Pa;  ///< what break-away forces may have the pressure difference off by
};

/// The parts of a force balance that turn an error of the environment into a force.
template <class T>
struct EnvironmentEffects {
  EdgePoint<T> edge;
  T force_per_position_N_per_m;  ///< of the magnetic force
  T force_per_current_N_per_A;
  T sliding_N;   ///< friction while the spool slides, with what dither takes off
  T friction_N;  ///< the same without dither
  bool dithered;
};

/// What the environment leaves open of the force that the pressure difference is estimated from [N], one standard
/// deviation. What a position error does to force and conductance belongs together: the one takes off the other.
template <class T>
SPOOLFLOW_NOINLINE constexpr T environment_N(const ObserverParameters<T>& valve, const EnvironmentEffects<T>& effects,
                                             const OperatingPoint<T>& at) {
  const Environment<T>& environment = valve.environment;
  const MeteringEdge<T>& edge = valve.edge;
  const T position_m = at.position_m, pressure_Pa = at.pressure_difference_Pa;
  const T widest = edge.conductance.node(0, 1, edge_positions - 1);
  const T least = larger(T(least_conductance_share) * widest, T(vanishing_conductance));
  const T off_m = sqrt(squared(environment.position_m) + squared(environment.position_share * position_m));
  const auto column_at = [&](T place_m) { return locate<edge_positions>(edge.position_m, place_m); };
  const Cell<T> row = locate<edge_pressures>(edge.pressure_difference_Pa, pressure_Pa);
  const EdgePoint<T> there = edge.at(at.oil_layer, row, column_at(position_m + off_m), pressure_Pa);
  const T stiffness_N_per_m = valve.spring.at(position_m).slope - effects.force_per_position_N_per_m;
  const T moved_N = edge_effect_N(effects.edge, there, pressure_Pa, least) - stiffness_N_per_m * off_m;
  const Cell<T> warmer_layer{at.oil_layer.index,
                             at.oil_layer.share + environment.oil_temperature_K * edge.temperature_K.per_spacing};
  const EdgePoint<T> warmer = edge.at(warmer_layer, row, column_at(position_m), pressure_Pa);
  const T warmer_N = edge_effect_N(effects.edge, warmer, pressure_Pa, least);
  const T current_N = environment.current_share * at.current_A * effects.force_per_current_N_per_A;
  // About the mean of the swing one iron keeps its loop (stops, Preisach), another's closes (Coleman and Hodgdon).
  const T loop_N = effects.dithered ? environment.dithered_loop_A * effects.force_per_current_N_per_A : T(0);
  const T ripple_N = effects.edge.flow_force_per_pressure_N_Pa * environment.ripple_Pa;
  const T freed_N = smaller(ripple_N, effects.sliding_N);
  const T friction_N = environment.friction_share * effects.friction_N;
  const T breakaway_N = effects.edge.flow_force_per_pressure_N_Pa * at.breakaway_Pa;
  const T all_N =
      sqrt(squared(environment.force_N) + squared(current_N) + squared(loop_N) + squared(moved_N) + squared(warmer_N) +
           squared(ripple_N) + squared(freed_N) + squared(friction_N) + squared(breakaway_N));
  return smaller(all_N, T(most_environment_N));
}

/// Oil colder or warmer than what was measured: one standard deviation of the flow rate that is left open, as a share
/// of it, over how far the trend is continued [1/K].
inline constexpr double continued_flow_share_per_K = 0.002;

/// The same as a force [N], by where the oil temperature lies between the layers of the tables.
template <class T>
constexpr T continued_oil_N(const MeteringEdge<T>& tables, T layer_share, const EdgePoint<T>& edge,
                            T pressure_difference_Pa) {
  const T beyond_K = magnitude(layer_share - limited(layer_share, T(0), T(1))) * tables.temperature_K.spacing;
  return T(2 * continued_flow_share_per_K) * beyond_K * edge.flow_force_per_pressure_N_Pa * pressure_difference_Pa;
}

/// Half the width that the flow's own residual takes in the band, over its standard deviation.
inline constexpr double flow_residual_factor = 2.1;

/// Half the width that the swing of friction under dither takes, as a share of half of it: peaks that no sample met.
inline constexpr double swing_deviation_share = 0.03;
/// Contacts that slide faster are younger, and a film carries: friction may fall with the spool's speed by up to a
/// quarter of what benches at no more than this speed [m/s] show (Dieterich 1979; Armstrong-Helouvry 1994). Half the
/// width that it takes, as a share of friction over the speed beyond [s/m], and at most.
inline constexpr double bench_speed_m_per_s = 1e-4;
inline constexpr double friction_share_per_speed_s_per_m = 800;
inline constexpr double most_friction_share_of_speed = 0.24;
/// Friction that operation has shown to differ from what was calibrated may differ again with speed and place: half the
/// width that it takes, over the share of friction by which it differs.
inline constexpr double displaced_friction_factor = 2;
/// Half the width that an innovation takes while the spool slides, over the innovation.
inline constexpr double innovation_factor = 1.5;
/// While the spool slips the pressure difference may move with it: the band is so many times wider.
inline constexpr double slip_widening = 1.8;
/// Friction at rest seldom lies at an end of its interval: half the width that the interval leaves to a side, over what
/// it leaves to that side times that side's share of the interval.
inline constexpr double interval_share = 0.75;
/// No interval of friction counts as shorter [N]: its parts are divided by it.
inline constexpr double least_interval_N = 1e-6;
/// A supply that moved while the spool rested, as friction at its bound showed, may go on unobserved: by as much as it
/// was seen to move, but by no more than this share of what friction's other bound leaves.
inline constexpr double unobserved_room_share = 0.25;
/// Half-width that the constrained correction at rest takes, over that correction: friction may have held it instead.
inline constexpr double constrained_correction_factor = 2;
/// At rest more may be open to one side than to the other: the pressure difference is expected beyond the estimate by
/// this share of their difference.
inline constexpr double asymmetry_share = 0.15;
/// A supply at the highest calibrated pressure difference ripples about it: the band reaches so much further, as a
/// share of it.
inline constexpr double ripple_share = 0.02;

/// One standard deviation of where the bounds of friction at rest lie [N]: it grows while the spool rests.
template <class T>
constexpr T bounds_deviation_N(const BandParameters<T>& band, T rest_s) {
  return band.tolerance_N * (T(1) + band.creep_per_s * rest_s);
}

/// One standard deviation of the pressure difference that a force error makes [Pa].
template <class T>
SPOOLFLOW_INLINE constexpr T pressure_deviation_Pa(const EdgePoint<T>& edge, T force_N) {
  return force_N / edge.flow_force_per_pressure_N_Pa;
}

/// What is left open of the pressure difference [Pa].
template <class T>
struct PressureBand {
  T least_Pa;     ///< >= 0
  T expected_Pa;  ///< to answer with
  T most_Pa;      ///< hardly above the highest that was calibrated
};

/// By how much the pressure difference at rest is expected beyond the estimate: the supply may have gone on unobserved,
/// in the direction in which the estimate was corrected.
template <class T>
SPOOLFLOW_INLINE constexpr T unobserved_Pa(const PressureState<T>& pressure, const ForceBalance<T>& balance) {
  const T corrected_Pa = pressure.constrained_correction_Pa;
  const bool rises = corrected_Pa > T(0);
  const T room_N =
      rises ? balance.residual_force_N - balance.resting.lower_N : balance.resting.upper_N - balance.residual_force_N;
  const T room_Pa = T(unobserved_room_share) * pressure_deviation_Pa(balance.edge, at_least_zero(room_N));
  const T gone_Pa = smaller(magnitude(corrected_Pa), room_Pa);
  return rises ? gone_Pa : -gone_Pa;
}

/// What motion leaves open of the forces, to either side [N]: what they ask for beyond the estimate, friction that
/// depends on speed, friction that operation has shown to differ by `displaced_ratio` (>= 0) from what was calibrated,
/// and the swing of friction under dither.
template <class T>
SPOOLFLOW_INLINE constexpr T motion_deviation_N(const ForceBalance<T>& balance, T velocity_m_per_s, T displaced_ratio) {
  const T beyond_m_per_s = at_least_zero(magnitude(velocity_m_per_s) - T(bench_speed_m_per_s));
  const T of_speed = smaller(T(friction_share_per_speed_s_per_m) * beyond_m_per_s, T(most_friction_share_of_speed));
  const T sliding_N = T(innovation_factor) * magnitude(balance.residual_force_N - balance.friction_N) +
                      magnitude(balance.friction_N) * (of_speed + T(displaced_friction_factor) * displaced_ratio);
  return (balance.sliding ? sliding_N : T(0)) + T(swing_deviation_share) * balance.half_swing_N;
}

/// Half the width [Pa] where both what is open (one over its square) and how far friction's bound lies limit the error.
template <class T>
SPOOLFLOW_INLINE constexpr T within_both_Pa(const EdgePoint<T>& edge, T per_open_1_N2, T bound_N) {
  return pressure_deviation_Pa(edge, bound_N / sqrt(T(1) + squared(bound_N) * per_open_1_N2));
}

/// After the update of the pressure difference; `displaced_ratio` as below `motion_deviation_N`. At rest both what is
/// open and how far friction's interval and the uncertainty of its bounds reach limit the error: each side lies below
/// either.
template <class T>
SPOOLFLOW_INLINE constexpr PressureHalfWidths<T> pressure_half_widths(const BandParameters<T>& band,
                                                                      const PressureState<T>& pressure,
                                                                      const ForceBalance<T>& balance, T rest_s,
                                                                      T velocity_m_per_s, T displaced_ratio,
                                                                      T environment_N) {
  const T share = balance.sliding ? band.force_share : band.rest_share;
  const T slope = balance.edge.flow_force_per_pressure_N_Pa;
  const T unobserved_N2 = squared(slope * unobserved_change_Pa(pressure, band.unobserved_factor));
  const T factor = band.coverage_factor * pressure.band_factor * (balance.slips ? T(slip_widening) : T(1));
  T open_N2 = squared(factor) * (unobserved_N2 + squared(share * balance.noise_N));
  if (balance.sliding || balance.dithered)
    open_N2 += squared(motion_deviation_N(balance, velocity_m_per_s, displaced_ratio));
  open_N2 += squared(band.coverage_factor * environment_N);
  const T open_Pa = pressure_deviation_Pa(balance.edge, sqrt(open_N2));
  PressureHalfWidths<T> widths{open_Pa, open_Pa, T(0)};
  // The mean of friction over a period of dither has bounds in slips, too.
  const bool bounded = !balance.sliding && (!balance.slips || (balance.dithered && balance.settled)) && !balance.closed;
  if (bounded) {
    open_N2 += squared(T(constrained_correction_factor) * slope * pressure.constrained_correction_Pa);
    const T bounds_N = band.force_share * balance.noise_N + bounds_deviation_N(band, rest_s);
    const T certain_N = band.coverage_factor * sqrt(squared(bounds_N) + squared(environment_N));
    const T upper_N = at_least_zero(balance.resting.upper_N - balance.residual_force_N);
    const T lower_N = at_least_zero(balance.residual_force_N - balance.resting.lower_N);
    const T per_open_1_N2 = T(1) / open_N2;
    widths.bias_Pa = T(asymmetry_share) * (within_both_Pa(balance.edge, per_open_1_N2, lower_N + certain_N) -
                                           within_both_Pa(balance.edge, per_open_1_N2, upper_N + certain_N));
    const T per_interval = T(interval_share) / larger(upper_N + lower_N, T(least_interval_N));
    const T below_N = per_interval * squared(upper_N) + certain_N;
    const T above_N = per_interval * squared(lower_N) + certain_N;
    widths.below_Pa = within_both_Pa(balance.edge, per_open_1_N2, below_N);
    widths.above_Pa = within_both_Pa(balance.edge, per_open_1_N2, above_N);
    // Friction may have held what was corrected: the pressure difference may be back where it was.
    const T corrected_Pa = pressure.constrained_correction_Pa;
    const T usual_Pa = band.coverage_factor * unobserved_change_Pa(pressure, band.unobserved_factor);
    widths.bias_Pa -= T(asymmetry_share) * (corrected_Pa - limited(corrected_Pa, -usual_Pa, usual_Pa));
    if (corrected_Pa > T(0)) widths.below_Pa = sqrt(squared(widths.below_Pa) + squared(corrected_Pa));
    if (corrected_Pa < T(0)) widths.above_Pa = sqrt(squared(widths.above_Pa) + squared(corrected_Pa));
  }
  const bool corrected = !is_zero(pressure.constrained_correction_Pa) && !balance.sliding && !balance.closed;
  if (corrected) widths.bias_Pa += unobserved_Pa(pressure, balance);
  return widths;
}

/// No valve bears a pressure difference beyond this multiple of the highest that is answered.
inline constexpr double capped_pressure_reach = 10;

/// The pressure difference to answer with, from 0 to the highest that is answered, and what `widths` leave open of it.
/// Where the estimate stands at that highest one, the truth may lie above it, up to what no valve bears.
template <class T>
SPOOLFLOW_INLINE constexpr PressureBand<T> pressure_band(const PressureState<T>& pressure,
                                                         const PressureHalfWidths<T>& widths, T highest_Pa) {
  const T estimate_Pa = pressure.pressure_difference_Pa;
  const T usual_Pa = T(1 + ripple_share) * highest_Pa;
  T most_Pa = estimate_Pa + widths.above_Pa;
  if (most_Pa > usual_Pa)
    most_Pa = is_capped(pressure, highest_Pa) ? smaller(most_Pa, T(capped_pressure_reach) * highest_Pa) : usual_Pa;
  return {at_least_zero(estimate_Pa - widths.below_Pa), from_zero_to(highest_Pa, estimate_Pa + widths.bias_Pa),
          most_Pa};
}

/// Variance of the flow rate that the machine around the valve leaves open beside the pressure difference [m6/s2].
template <class T>
SPOOLFLOW_INLINE constexpr T environment_variance(const Environment<T>& environment, T flow_m3_per_s) {
  if (is_zero(environment.flow_share) && is_zero(environment.leakage_m3_per_s)) return T(0);
  return squared(environment.flow_share * flow_m3_per_s) + squared(environment.leakage_m3_per_s);
}

/// The band of the flow rate [m3/s]: what the pressure difference leaves open of it, from `least` to `most`, and the
/// flow's own residual, which knows nothing of it.
template <class T>
SPOOLFLOW_INLINE constexpr void band_of_flow(const ObserverParameters<T>& valve, T least_m3_per_s, T most_m3_per_s,
                                             Estimate<T>& out) {
  const BandParameters<T>& band = valve.band;
  out.flow_lower_m3_per_s = least_m3_per_s;
  out.flow_upper_m3_per_s = most_m3_per_s;
  widen_band(out, squared(T(flow_residual_factor) * band.flow_residual_m3_per_s) +
                      squared(band.coverage_factor) * environment_variance(valve.environment, out.flow_m3_per_s));
}

/// A stalled actuator: the cylinder stands at its end or a load holds it, nothing flows through an open valve, and no
/// pressure difference is left over it. It is as likely as a small pressure difference where the flow force is this
/// share of sliding friction ...
inline constexpr double stalled_friction_share = 0.3;
/// ... and the pressure difference this share of the highest.
inline constexpr double stalled_pressure_share = 0.025;
/// Beyond this multiple of that share no actuator counts as stalled.
inline constexpr double stalled_pressure_reach = 4;
/// A band of 95 % holds what is more likely than this.
inline constexpr double least_likelihood = 0.05;

/// Where the actuator may have stalled the expected flow is that much less, and the band holds none.
template <class T>
constexpr void admit_stall(const ForceBalance<T>& balance, T pressure_difference_Pa, T highest_Pa, Estimate<T>& out) {
  const T reach_Pa = T(stalled_pressure_reach * stalled_pressure_share) * highest_Pa;
  if (!lies_below(pressure_difference_Pa, reach_Pa) || balance.closed) return;
  const T stalled_Pa = T(stalled_pressure_share) * highest_Pa;
  const T stalled_N = T(stalled_friction_share) * (balance.spool_friction_N + balance.armature_friction_N);
  const T size2 = squared(pressure_difference_Pa / stalled_Pa) + squared(balance.edge.flow_force_N / stalled_N);
  const T stalled = T(1) / (T(1) + squared(size2));
  out.flow_m3_per_s *= T(1) - stalled;
  if (stalled > T(least_likelihood)) out.flow_lower_m3_per_s = smaller(out.flow_lower_m3_per_s, T(0));
}

/// How far the pressure difference may lie while no force shows it. `edge` is that of the last position or of the one
/// that is measured still.
template <class T>
constexpr PressureHalfWidths<T> unobserved_half_widths(const BandParameters<T>& band, const PressureState<T>& pressure,
                                                       const ForceErrors<T>& errors, const EdgePoint<T>& edge) {
  const T known_N2 = squared(band.rest_share * errors.noise_N) + squared(errors.environment_N);
  const T known_Pa = pressure_deviation_Pa(edge, sqrt(known_N2));
  const T open_Pa = band.coverage_factor * pressure.band_factor *
                    sqrt(squared(unobserved_change_Pa(pressure, band.unobserved_factor)) + squared(known_Pa));
  return {open_Pa, open_Pa, T(0)};
}

/// Conductances [m3/s/sqrt(Pa)] of where the spool may stand; < 0 through the other direction's edge.
template <class T>
struct Passage {
  T expected;
  T least;
  T most;
};

/// The flow rate [m3/s] of what passes at what is open of the pressure difference, with its band.
template <class T>
SPOOLFLOW_INLINE constexpr void answer_flow(const ObserverParameters<T>& valve, const Passage<T>& passage,
                                            const PressureBand<T>& band, Estimate<T>& out) {
  out.pressure_difference_Pa = band.expected_Pa;
  out.flow_m3_per_s = at_least_zero(passage.expected * sqrt(band.expected_Pa));
  const T backward_Pa = passage.least < T(0) ? band.most_Pa : band.least_Pa;
  band_of_flow(valve, passage.least * sqrt(backward_Pa), passage.most * sqrt(band.most_Pa), out);
}

}  // namespace spoolflow::sensor
