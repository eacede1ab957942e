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
#include "spoolflow/rig/plant/plant_memory.hpp"
#include "spoolflow/rig/plant/plant_solver.hpp"

namespace spoolflow::rig {

/// Position and velocity an external drive imposes at a time after the call's start.
struct ImposedPath {
  double start_m, start_m_per_s, end_m, end_m_per_s, duration_s;

  [[nodiscard]] std::array<double, 2> at(double time_s) const {
    const double s = time_s / duration_s;
    const double chord = (end_m - start_m) / duration_s;
    const double a = start_m_per_s - chord;
    const double b = end_m_per_s - chord;
    // Cubic through both ends: chord plus s (1 - s) [a (1 - s) - b s].
    return {start_m + duration_s * s * (chord + (1.0 - s) * (a * (1.0 - s) - b * s)),
            chord + a * (1.0 - s) * (1.0 - 3.0 * s) + b * s * (3.0 * s - 2.0)};
  }
};

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
struct ErrorScale {
  double per_stroke, per_flux_a, per_linkage_a, per_flux_b, per_linkage_b;
  static constexpr double per_pressure = 1e-7;

  ErrorScale(const PlantParameters& p, const PlantConstants& c)
      : per_stroke(1.0 / p.spool.stroke_m),
        per_flux_a(c.solenoid_a_constants.per_iron_area_m2 / p.solenoid_a.iron.saturation_T),
        per_linkage_a(per_flux_a / c.solenoid_a_constants.turns),
        per_flux_b(c.solenoid_b_constants.per_iron_area_m2 / p.solenoid_b.iron.saturation_T),
        per_linkage_b(per_flux_b / c.solenoid_b_constants.turns) {}

  [[nodiscard]] double operator()(const PlantVector& error) const {
    double largest = per_stroke * std::max(std::abs(error[state_x]), 5e-3 * std::abs(error[state_v]));
    largest = std::max(largest, std::abs(solenoid_a_of(error)[state_linkage]) * per_linkage_a);
    largest = std::max(largest, std::abs(solenoid_a_of(error)[state_flux]) * per_flux_a);
    largest = std::max(largest, std::abs(solenoid_b_of(error)[state_linkage]) * per_linkage_b);
    largest = std::max(largest, std::abs(solenoid_b_of(error)[state_flux]) * per_flux_b);
    for (const auto pressure : {state_p_P, state_p_A, state_p_B}) {
      largest = std::max(largest, std::abs(hydraulics_of(error)[pressure]) * per_pressure);
    }
    return largest;
  }
};

/// What stays the same over the internal steps of one call.
struct StepContext {
  const PlantParameters& parameters;
  const PlantConstants& constants;
  const PlantInput& input;
  const ErrorScale& scale;
  const ImposedPath* path;  ///< null when the body moves freely
  double start_s;           ///< plant time at which the call began
};

/// Takes one step of length h unless its error exceeds `tolerance`; the state is untouched then. Returns the error.
inline double internal_step(const StepContext& context, PlantState& state, double h, double tolerance,
                            PlantLosses& losses) {
  using Method = Ros34pw2;
  const PlantParameters& p = context.parameters;
  const PlantConstants& c = context.constants;
  const PlantVector u0 = differential_states(state);
  PlantRates first, last;
  plant_rates(p, c, state, context.input, u0, contact_ages(state), state.time_s, first);
  const PlantSolver solve(p, c, first, Method::gamma * h);

  PlantVector stage[4] = {};
  PlantVector u = u0;
  ContactAges ages{};
  solve(c, first.rate, stage[0]);
  for (double& value : stage[0]) value *= Method::gamma * h;
  for (std::size_t s = 1; s < 4; ++s) {
    const double elapsed = Method::alpha[s] * h;
    PlantVector right{};
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
    for (double& value : stage[s]) value *= Method::gamma;
  }
  PlantVector difference;
  for (std::size_t i = 0; i < plant_states; ++i) {
    difference[i] = Method::e[0] * stage[0][i] + Method::e[1] * stage[1][i] + Method::e[2] * stage[2][i] +
                    Method::e[3] * stage[3][i];
  }
  if (context.path != nullptr) difference[state_x] = difference[state_v] = 0.0;
  const double error = context.scale(difference);
  if (!(error <= tolerance)) return error;

  PlantVector end = u;
  for (std::size_t i = 0; i < plant_states; ++i) end[i] += stage[3][i];
  if (context.path != nullptr) {  // the fourth stage stands at the step's end
    end[state_x] = u[state_x];
    end[state_v] = u[state_v];
  }
  commit(p, c, state, end, first, last, ages, h, losses);
  return error;
}

}  // namespace spoolflow::rig
