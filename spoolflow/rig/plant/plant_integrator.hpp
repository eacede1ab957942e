#pragma once
/// One internal step of the plant: the W-method ROS34PW2 (Rang and Angermann, BIT 45, 2005) in four stages,
///
///     (1 - g h A) U_i/(g h) = f(t + alpha_i h, u + sum a_ij U_j) + sum c_ij/h U_j,   u <- u + sum m_i U_i
///
/// Third order for any matrix A, L-stable and stiffly accurate where A is the Jacobian. So A holds what is stiff, block
/// by block: each solenoid (3 states), the body's contacts and drag (2), the volumes with the cylinder (5); what
/// couples the blocks is slow against a step and enters explicitly. An embedded second-order result estimates the
/// error; a step that is too long is not taken, and its half is tried. Four evaluations a step, no iteration, no
/// allocation.
#include <cstdint>

#include "spoolflow/rig/plant/plant_dynamics.hpp"
#include "spoolflow/rig/plant/plant_memory.hpp"

namespace spoolflow::rig {

// The matrix A, block by block: each solenoid's three states, the body's contacts and drag, the volumes with the
// cylinder.

/// The body's pair of states: (1 - w J) k = r with contact stiffness and damping.
template <class Scalar>
struct BodySolver {
  Scalar weight_s, stiffness_per_s2, pivot;

  BodySolver(const PlantConstantsOf<Scalar>& constants, const PlantRatesOf<Scalar>& point, Scalar w) : weight_s(w) {
    Scalar flow_damping = 0.0;
    if (constants.hydraulics) {
      for (std::size_t i = 0; i < 4; ++i) {
        flow_damping -= constants.density_kg_per_m3 * constants.edges[i]->damping_length_m *
                        point.hydraulics.edges[i].flow_gain_m2_per_s;
      }
    }
    const Scalar stiffness = point.spring.stiffness_N_per_m + point.spool_friction.stiffness_N_per_m +
                             point.armature_a_friction.stiffness_N_per_m + point.armature_b_friction.stiffness_N_per_m +
                             point.end_stop.stiffness_N_per_m;
    const Scalar damping = constants.spool_drag_N_s_per_m + constants.armature_drag_N_s_per_m +
                           point.end_stop.damping_N_s_per_m + larger(Scalar(0.0), flow_damping);
    stiffness_per_s2 = stiffness / constants.mass_kg;
    pivot = 1.0 / (1.0 + w * (damping / constants.mass_kg + w * stiffness_per_s2));
  }

  void operator()(const PlantVectorOf<Scalar>& right, PlantVectorOf<Scalar>& k) const {
    k[state_v] = (right[state_v] - weight_s * stiffness_per_s2 * right[state_x]) * pivot;
    k[state_x] = right[state_x] + weight_s * k[state_v];
  }
};

/// (1 - w A) k = r for the whole plant, block by block.
template <class Scalar>
struct PlantSolver {
  BodySolver<Scalar> body;
  SolenoidSolver<Scalar> solenoid_a, solenoid_b;
  HydraulicSolver<Scalar> hydraulics;

  PlantSolver(const PlantParametersOf<Scalar>& p, const PlantConstantsOf<Scalar>& c, const PlantRatesOf<Scalar>& point,
              Scalar w)
      : body(c, point, w) {
    if (c.magnetic_a) solenoid_a = SolenoidSolver<Scalar>(c.solenoid_a_constants, point.solenoid_a, w);
    if (c.magnetic_b) solenoid_b = SolenoidSolver<Scalar>(c.solenoid_b_constants, point.solenoid_b, w);
    if (c.hydraulics) hydraulics = HydraulicSolver<Scalar>(p.supply, p.load, point.hydraulics, w);
  }

  void operator()(const PlantConstantsOf<Scalar>& c, const PlantVectorOf<Scalar>& right,
                  PlantVectorOf<Scalar>& k) const {
    body(right, k);
    if (c.magnetic_a) solenoid_a(solenoid_a_of(right), solenoid_a_of(k));
    if (c.magnetic_b) solenoid_b(solenoid_b_of(right), solenoid_b_of(k));
    if (c.hydraulics) hydraulics(hydraulics_of(right), hydraulics_of(k));
  }
};

/// Position and velocity an external drive imposes at a time after the call's start.
template <class Scalar>
struct ImposedPathOf {
  Scalar start_m, start_m_per_s, end_m, end_m_per_s, duration_s;

  [[nodiscard]] std::array<Scalar, 2> at(Scalar time_s) const {
    const Scalar s = time_s / duration_s;
    const Scalar chord = (end_m - start_m) / duration_s;
    const Scalar a = start_m_per_s - chord;
    const Scalar b = end_m_per_s - chord;
    // Cubic through both ends: chord plus s (1 - s) [a (1 - s) - b s].
    return {start_m + duration_s * s * (chord + (1.0 - s) * (a * (1.0 - s) - b * s)),
            chord + a * (1.0 - s) * (1.0 - 3.0 * s) + b * s * (3.0 * s - 2.0)};
  }
};
using ImposedPath = ImposedPathOf<double>;

/// Method coefficients in the form above, from gamma, alpha_ij, gamma_ij of the paper: a = alpha Gamma^-1,
/// c = diag(1/gamma) - Gamma^-1, m = b Gamma^-1 (the fourth stage's argument plus U_4), e = (b - b^) Gamma^-1.
struct Ros34pw2 {
  static constexpr double gamma = 0.43586652150845900;
  static constexpr double alpha[4] = {0.0, 0.87173304301691801, 0.73157995778885238, 1.0};
  static constexpr double a[4][3] = {{0, 0, 0},
                                     {2.0, 0, 0},
                                     {1.4192173174557647, -0.25923221167296973, 0},
                                     {4.1847604823191604, -0.28519201735549599, 2.2942803602790418}};
  static constexpr double c[4][3] = {{0, 0, 0},
                                     {-4.5885607205580836, 0, 0},
                                     {-4.1847604823191595, 0.28519201735549599, 0},
                                     {-6.3681792001283597, -6.7956209444668367, 2.8700986043310555}};
  static constexpr double e[4] = {0.2777499476479681, -1.4032398951759992, 1.7726301276675507, 0.5};
};

/// Error of a step over full scale: stroke, the stroke in 5 ms, saturation flux and linkage, 100 bar.
template <class Scalar>
struct ErrorScaleOf {
  Scalar per_stroke, per_flux_a, per_linkage_a, per_flux_b, per_linkage_b;
  static constexpr double per_pressure = 1e-7;

  ErrorScaleOf(const PlantParametersOf<Scalar>& p, const PlantConstantsOf<Scalar>& c)
      : per_stroke(1.0 / p.spool.stroke_m),
        per_flux_a(c.solenoid_a_constants.per_iron_area_m2 / p.solenoid_a.iron.saturation_T),
        per_linkage_a(per_flux_a / c.solenoid_a_constants.turns),
        per_flux_b(c.solenoid_b_constants.per_iron_area_m2 / p.solenoid_b.iron.saturation_T),
        per_linkage_b(per_flux_b / c.solenoid_b_constants.turns) {}

  [[nodiscard]] Scalar operator()(const PlantVectorOf<Scalar>& error) const {
    Scalar largest = per_stroke * larger(magnitude(error[state_x]), 5e-3 * magnitude(error[state_v]));
    largest = larger(largest, magnitude(solenoid_a_of(error)[state_linkage]) * per_linkage_a);
    largest = larger(largest, magnitude(solenoid_a_of(error)[state_flux]) * per_flux_a);
    largest = larger(largest, magnitude(solenoid_b_of(error)[state_linkage]) * per_linkage_b);
    largest = larger(largest, magnitude(solenoid_b_of(error)[state_flux]) * per_flux_b);
    for (const auto pressure : {state_p_P, state_p_A, state_p_B}) {
      largest = larger(largest, magnitude(hydraulics_of(error)[pressure]) * per_pressure);
    }
    return largest;
  }
};
using ErrorScale = ErrorScaleOf<double>;

/// How long the steps may be within a period: on a grid of ticks, in strides of powers of two.
struct StrideGrid {
  double finest_s;
  std::int64_t ticks_per_longest, end;  ///< [ticks]
};

[[nodiscard]] StrideGrid stride_grid(const Integration& integration, double dt_s);

/// Throws std::runtime_error: the state has no finite successor after a time h.
[[noreturn]] void diverged(const PlantState& state, double h);

/// What stays the same over the internal steps of one call.
template <class Scalar>
struct StepContextOf {
  const PlantParametersOf<Scalar>& parameters;
  const PlantConstantsOf<Scalar>& constants;
  const PlantInputOf<Scalar>& input;
  const ErrorScaleOf<Scalar>& scale;
  const ImposedPathOf<Scalar>* path;  ///< null when the body moves freely
  Scalar start_s;                     ///< plant time at which the call began
};
using StepContext = StepContextOf<double>;

/// Takes one step of length h unless its error exceeds `tolerance`; the state is untouched then. Returns the error. Of
/// several valves, those that are `moving`.
template <class Scalar>
inline Scalar internal_step(const StepContextOf<Scalar>& context, PlantStateOf<Scalar>& state, Scalar h,
                            Scalar tolerance, PlantLossesOf<Scalar>& losses, const Given<Mask<Scalar>>& moving = true) {
  using Method = Ros34pw2;
  const PlantParametersOf<Scalar>& p = context.parameters;
  const PlantConstantsOf<Scalar>& c = context.constants;
  const PlantVectorOf<Scalar> u0 = differential_states(state);
  PlantRatesOf<Scalar> first, last;
  plant_rates(p, c, state, context.input, u0, contact_ages(state), state.time_s, first);
  const PlantSolver<Scalar> solve(p, c, first, Method::gamma * h);

  PlantVectorOf<Scalar> stage[4] = {};
  PlantVectorOf<Scalar> u = u0;
  ContactAgesOf<Scalar> ages{};
  solve(c, first.rate, stage[0]);
  for (Scalar& value : stage[0]) value *= Method::gamma * h;
  for (std::size_t s = 1; s < 4; ++s) {
    const Scalar elapsed = Method::alpha[s] * h;
    PlantVectorOf<Scalar> right{};
    u = u0;
    for (std::size_t j = 0; j < s; ++j) {
      for (std::size_t i = 0; i < plant_states; ++i) {
        u[i] += Method::a[s][j] * stage[j][i];
        right[i] += Method::c[s][j] * stage[j][i];
      }
    }
    if (context.path != nullptr) {
      const auto [x, v] = context.path->at(state.time_s - context.start_s + elapsed);
      u[state_x] = x;
      u[state_v] = v;
    }
    ages = contact_ages(c, state, first, u, elapsed);
    plant_rates(p, c, state, context.input, u, ages, state.time_s + elapsed, last);
    for (std::size_t i = 0; i < plant_states; ++i) right[i] += h * last.rate[i];
    solve(c, right, stage[s]);
    for (Scalar& value : stage[s]) value *= Method::gamma;
  }
  PlantVectorOf<Scalar> difference;
  for (std::size_t i = 0; i < plant_states; ++i) {
    difference[i] = Method::e[0] * stage[0][i] + Method::e[1] * stage[1][i] + Method::e[2] * stage[2][i] +
                    Method::e[3] * stage[3][i];
  }
  if (context.path != nullptr) difference[state_x] = difference[state_v] = 0.0;
  const Scalar error = context.scale(difference);
  const Mask<Scalar> taken = moving && error <= tolerance;
  if (!any(taken)) return error;

  PlantVectorOf<Scalar> end = u;
  for (std::size_t i = 0; i < plant_states; ++i) end[i] += stage[3][i];
  if (context.path != nullptr) {  // the fourth stage stands at the step's end
    end[state_x] = u[state_x];
    end[state_v] = u[state_v];
  }
  commit(p, c, state, end, first, last, ages, h, losses, taken);
  return error;
}

}  // namespace spoolflow::rig
