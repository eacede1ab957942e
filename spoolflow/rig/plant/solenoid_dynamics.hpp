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
using SolenoidVector = std::span<const double, solenoid_states>;
using SolenoidRate = std::span<double, solenoid_states>;

/// What does not change within a step.
struct SolenoidConstants {
  double turns;
  double resistance_ohm;
  double per_leakage_inductance_H;  ///< 1/(N^2 P_leak)
  double radial_reluctance_per_H;
  double ladder_conductance_S;  ///< 1/(r_1 + r_2)
  double total_resistance_ohm;  ///< 1/G
  double skin_share;            ///< r_2/(r_1 + r_2)
  double skin_rate_per_s;       ///< r_2/l_2
  double side_force_N_per_Wb2;
  double iron_length_m;
  double per_iron_area_m2;
  Iron iron;
  WorkingGap gap;
};

inline SolenoidConstants solenoid_constants(const Solenoid& solenoid, const CoilHeatState& heat) {
  const double turns = active_turns(solenoid.coil);
  const double ladder = 1.0 / (solenoid.eddy.core_resistance_ohm + solenoid.eddy.skin_resistance_ohm);
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

struct SolenoidRates {
  double current_A;
  double eddy_current_A;    ///< j
  double induced_V;         ///< e, one turn
  double magnetic_force_N;  ///< towards its own pole
  double side_force_N;
  double iron_slope_per_H;  ///< dU/dPhi
};

/// At the states, with the iron's memory at the step's start, the armature's travel towards its pole,
/// and the voltage over the terminals.
inline SolenoidRates solenoid_rates(const SolenoidConstants& constants, const SolenoidState& start,
                                    SolenoidVector states, double travel_m, double voltage_V, SolenoidRate rate) {
  const double linkage = states[state_linkage], flux = states[state_flux], skin = states[state_skin];
  const FieldPoint iron = iron_field(constants.iron, start.iron, flux * constants.per_iron_area_m2);
  const GapPermeance gap = gap_permeance(constants.gap, travel_m);
  const double per_gap = 1.0 / gap.permeance_H;
  const double reluctance = constants.radial_reluctance_per_H + per_gap;
  const double drop = constants.iron_length_m * iron.field_A_per_m + flux * reluctance;

  const double current = (linkage - constants.turns * flux) * constants.per_leakage_inductance_H;
  const double induced =
      (constants.turns * current - drop - constants.skin_share * skin) * constants.total_resistance_ohm;
  const double eddy = induced * constants.ladder_conductance_S + constants.skin_share * skin;
  const double gap_drop = flux * per_gap;
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
class SolenoidSolver {
 public:
  SolenoidSolver() = default;
  SolenoidSolver(const SolenoidConstants& constants, const SolenoidRates& point, double weight_s) {
    const double per_leakage = constants.per_leakage_inductance_H;
    const double n = constants.turns;
    const double g = constants.total_resistance_ohm;
    // Rows: linkage (l), flux (f), skin (s).
    const double wR = weight_s * constants.resistance_ohm * per_leakage;
    linkage_pivot_ = 1.0 / (1.0 + wR);
    linkage_flux_ = -wR * n;  // coefficient of k_f in row l
    flux_linkage_ = -weight_s * n * per_leakage * g;
    const double flux_flux = 1.0 + weight_s * (n * n * per_leakage + point.iron_slope_per_H) * g;
    const double flux_skin = weight_s * constants.skin_share * g;
    const double wS = weight_s * constants.skin_rate_per_s;
    const double a = constants.ladder_conductance_S;
    skin_linkage_ = wS * a * (flux_linkage_ / weight_s);
    const double skin_flux = wS * a * (flux_flux - 1.0) / weight_s;
    const double skin_skin = 1.0 + wS * (1.0 - constants.skin_share + a * constants.skin_share * g);
    // Eliminate linkage.
    const double f = flux_linkage_ * linkage_pivot_;
    const double s = skin_linkage_ * linkage_pivot_;
    flux_flux_ = flux_flux - f * linkage_flux_;
    flux_skin_ = flux_skin;
    skin_flux_ = skin_flux - s * linkage_flux_;
    skin_skin_ = skin_skin;
    determinant_ = 1.0 / (flux_flux_ * skin_skin_ - flux_skin_ * skin_flux_);
    flux_linkage_ = f;
    skin_linkage_ = s;
  }

  void operator()(SolenoidVector right, SolenoidRate k) const {
    const double f = right[state_flux] - flux_linkage_ * right[state_linkage];
    const double s = right[state_skin] - skin_linkage_ * right[state_linkage];
    k[state_flux] = (f * skin_skin_ - flux_skin_ * s) * determinant_;
    k[state_skin] = (flux_flux_ * s - skin_flux_ * f) * determinant_;
    k[state_linkage] = (right[state_linkage] - linkage_flux_ * k[state_flux]) * linkage_pivot_;
  }

 private:
  double linkage_pivot_ = 0.0, linkage_flux_ = 0.0, flux_linkage_ = 0.0, skin_linkage_ = 0.0;
  double flux_flux_ = 0.0, flux_skin_ = 0.0, skin_flux_ = 0.0, skin_skin_ = 0.0, determinant_ = 0.0;
};

}  // namespace spoolflow::rig
