#pragma once
/// The solenoid's differential equations in its three electromagnetic states, with the Jacobian its integrator needs.
///
///     i   = (lambda - N Phi)/(N^2 P_leak)
///     U   = l H(Phi/A) + Phi (R_r + 1/P_g(s))                      magnetomotive force of iron and gaps
///     e   = (N i - U - r_2/(r_1 + r_2) j_2)/G,  G = 1/(r_1 + r_2) + G_shorted
///     dlambda/dt = u - R i,   dPhi/dt = e,   dj_2/dt = (r_2/l_2)(j - j_2),   j = (e + r_2 j_2)/(r_1 + r_2)
///
/// The iron's field is a function of the flux since the step's start; its memory is committed at the step's end.
#include <span>

#include "spoolflow/rig/plant/solenoid.hpp"

namespace spoolflow::rig {

/// Electromagnetic states, in this order.
enum SolenoidIndex { state_linkage, state_flux, state_skin, solenoid_states };
template <class Scalar>
using SolenoidVectorOf = Given<std::span<const Scalar, solenoid_states>>;
template <class Scalar>
using SolenoidRateOf = Given<std::span<Scalar, solenoid_states>>;

/// What does not change within a step.
template <class Scalar>
struct SolenoidConstantsOf {
  Scalar turns;
  Scalar resistance_ohm;
  Scalar per_leakage_inductance_H;  ///< 1/(N^2 P_leak)
  Scalar radial_reluctance_per_H;
  Scalar ladder_conductance_S;  ///< 1/(r_1 + r_2)
  Scalar total_resistance_ohm;  ///< 1/G
  Scalar skin_share;            ///< r_2/(r_1 + r_2)
  Scalar skin_rate_per_s;       ///< r_2/l_2
  Scalar side_force_N_per_Wb2;
  Scalar iron_length_m;
  Scalar per_iron_area_m2;
  IronOf<Scalar> iron;
  WorkingGapOf<Scalar> gap;
};
using SolenoidConstants = SolenoidConstantsOf<double>;

template <class Scalar>
inline SolenoidConstantsOf<Scalar> solenoid_constants(const SolenoidOf<Scalar>& solenoid,
                                                      const CoilHeatStateOf<Scalar>& heat) {
  const Scalar turns = active_turns(solenoid.coil);
  const Scalar ladder = 1.0 / (solenoid.eddy.core_resistance_ohm + solenoid.eddy.skin_resistance_ohm);
  return {
      .turns = turns,
      .resistance_ohm = resistance_ohm(solenoid.coil, heat.winding_temperature_C),
      .per_leakage_inductance_H = 1.0 / (turns * turns * solenoid.circuit.leakage_permeance_H),
      .radial_reluctance_per_H = radial_reluctance_per_H(solenoid.circuit),
      .ladder_conductance_S = ladder,
      .total_resistance_ohm = 1.0 / (ladder + shorted_turns_conductance_S(solenoid.coil, heat.winding_temperature_C)),
      .skin_share = solenoid.eddy.skin_resistance_ohm * ladder,
      .skin_rate_per_s = solenoid.eddy.skin_resistance_ohm / solenoid.eddy.skin_inductance_H,
      .side_force_N_per_Wb2 = side_force_per_flux_squared(solenoid.circuit),
      .iron_length_m = solenoid.circuit.iron_length_m,
      .per_iron_area_m2 = 1.0 / solenoid.circuit.iron_area_m2,
      .iron = iron_of(solenoid.iron, solenoid.hysteresis),
      .gap = working_gap(solenoid.circuit)};
}

template <class Scalar>
struct SolenoidRatesOf {
  Scalar current_A;
  Scalar eddy_current_A;    ///< j
  Scalar induced_V;         ///< e, one turn
  Scalar magnetic_force_N;  ///< towards its own pole
  Scalar side_force_N;
  Scalar iron_slope_per_H;  ///< dU/dPhi
};
using SolenoidRates = SolenoidRatesOf<double>;

/// At the states, with the iron's memory at the step's start, the armature's travel towards its pole,
/// and the voltage over the terminals.
template <class Scalar>
inline SolenoidRatesOf<Scalar> solenoid_rates(const SolenoidConstantsOf<Scalar>& constants,
                                              const SolenoidStateOf<Scalar>& start, SolenoidVectorOf<Scalar> states,
                                              Given<Scalar> travel_m, Given<Scalar> voltage_V,
                                              SolenoidRateOf<Scalar> rate) {
  const Scalar linkage = states[state_linkage], flux = states[state_flux], skin = states[state_skin];
  const FieldPointOf<Scalar> iron = iron_field(constants.iron, start.iron, flux * constants.per_iron_area_m2);
  const GapPermeanceOf<Scalar> gap = gap_permeance(constants.gap, travel_m);
  const Scalar per_gap = 1.0 / gap.permeance_H;
  const Scalar reluctance = constants.radial_reluctance_per_H + per_gap;
  const Scalar drop = constants.iron_length_m * iron.field_A_per_m + flux * reluctance;

  const Scalar current = (linkage - constants.turns * flux) * constants.per_leakage_inductance_H;
  const Scalar induced =
      (constants.turns * current - drop - constants.skin_share * skin) * constants.total_resistance_ohm;
  const Scalar eddy = induced * constants.ladder_conductance_S + constants.skin_share * skin;
  const Scalar gap_drop = flux * per_gap;
  rate[state_linkage] = voltage_V - constants.resistance_ohm * current;
  rate[state_flux] = induced;
  rate[state_skin] = constants.skin_rate_per_s * (eddy - skin);
  return {.current_A = current,
          .eddy_current_A = eddy,
          .induced_V = induced,
          .magnetic_force_N = 0.5 * gap_drop * gap_drop * gap.slope_H_per_m,
          .side_force_N = constants.side_force_N_per_Wb2 * flux * flux,
          .iron_slope_per_H = constants.iron_length_m * constants.per_iron_area_m2 * iron.slope_m_per_H + reluctance};
}

/// Solves (1 - w J) k = r with the Jacobian at `point`; w > 0 [s].
template <class Scalar>
class SolenoidSolver {
 public:
  SolenoidSolver() = default;
  SolenoidSolver(const SolenoidConstantsOf<Scalar>& constants, const SolenoidRatesOf<Scalar>& point, Scalar weight_s) {
    const Scalar per_leakage = constants.per_leakage_inductance_H;
    const Scalar n = constants.turns;
    const Scalar g = constants.total_resistance_ohm;
    // Rows: linkage (l), flux (f), skin (s).
    const Scalar wR = weight_s * constants.resistance_ohm * per_leakage;
    linkage_pivot_ = 1.0 / (1.0 + wR);
    linkage_flux_ = -wR * n;  // coefficient of k_f in row l
    flux_linkage_ = -weight_s * n * per_leakage * g;
    const Scalar flux_flux = 1.0 + weight_s * (n * n * per_leakage + point.iron_slope_per_H) * g;
    const Scalar flux_skin = weight_s * constants.skin_share * g;
    const Scalar wS = weight_s * constants.skin_rate_per_s;
    const Scalar a = constants.ladder_conductance_S;
    skin_linkage_ = wS * a * (flux_linkage_ / weight_s);
    const Scalar skin_flux = wS * a * (flux_flux - 1.0) / weight_s;
    const Scalar skin_skin = 1.0 + wS * (1.0 - constants.skin_share + a * constants.skin_share * g);
    // Eliminate linkage.
    const Scalar f = flux_linkage_ * linkage_pivot_;
    const Scalar s = skin_linkage_ * linkage_pivot_;
    flux_flux_ = flux_flux - f * linkage_flux_;
    flux_skin_ = flux_skin;
    skin_flux_ = skin_flux - s * linkage_flux_;
    skin_skin_ = skin_skin;
    determinant_ = 1.0 / (flux_flux_ * skin_skin_ - flux_skin_ * skin_flux_);
    flux_linkage_ = f;
    skin_linkage_ = s;
  }

  void operator()(SolenoidVectorOf<Scalar> right, SolenoidRateOf<Scalar> k) const {
    const Scalar f = right[state_flux] - flux_linkage_ * right[state_linkage];
    const Scalar s = right[state_skin] - skin_linkage_ * right[state_linkage];
    k[state_flux] = (f * skin_skin_ - flux_skin_ * s) * determinant_;
    k[state_skin] = (flux_flux_ * s - skin_flux_ * f) * determinant_;
    k[state_linkage] = (right[state_linkage] - linkage_flux_ * k[state_flux]) * linkage_pivot_;
  }

 private:
  Scalar linkage_pivot_ = 0.0, linkage_flux_ = 0.0, flux_linkage_ = 0.0, skin_linkage_ = 0.0;
  Scalar flux_flux_ = 0.0, flux_skin_ = 0.0, skin_flux_ = 0.0, skin_skin_ = 0.0, determinant_ = 0.0;
};

}  // namespace spoolflow::rig
