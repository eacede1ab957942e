/// The plant where its answer is known in closed form.
#include <cmath>
#include <complex>
#include <numbers>

#include <gtest/gtest.h>

#include "spoolflow/rig/plant/magnetic_circuit.hpp"
#include "spoolflow/rig/plant/solenoid_dynamics.hpp"
#include "tests/rig/plant/smooth_plant.hpp"

namespace spoolflow::rig {
namespace {

using std::numbers::pi;

TEST(PlantAnalytic, CurrentOfALinearSolenoidRisesAsResistorAndInductor) {
  PlantParameters p = reference::smooth_plant();
  p.arrangement = Arrangement::solenoid_bench;
  Solenoid& solenoid = p.solenoid_b;
  solenoid.iron = {.relative_permeability = 2000, .saturation_T = 2.3, .knee_width_T = 0.02};
  solenoid.eddy = {.core_resistance_ohm = 0.1, .skin_resistance_ohm = 0.1, .skin_inductance_H = 1e-9};
  const double travel_m = 1.2e-3;
  PlantInput input;
  input.motion = PrescribedMotion{.position_m = travel_m};
  PlantState state = plant_at_rest(p, input);

  // The iron's slope at zero flux in closed form, then reluctances in series and leakage in parallel.
  const double nu_0 = 1 / vacuum_permeability_H_per_m;
  const double nu = nu_0 / 2000;
  const double slope = nu + (nu_0 - nu) * (1 - 2.3 / std::hypot(2.3, 0.02));
  const double reluctance = solenoid.circuit.iron_length_m * slope / solenoid.circuit.iron_area_m2 +
                            radial_reluctance_per_H(solenoid.circuit) +
                            1 / gap_permeance(working_gap(solenoid.circuit), travel_m).permeance_H;
  const double turns = solenoid.coil.turns;
  const double inductance_H = turns * turns * (solenoid.circuit.leakage_permeance_H + 1 / reluctance);
  const double resistance =
      solenoid.coil.resistance_20C_ohm *
      (1 + solenoid.coil.temperature_coefficient_per_K * (state.solenoid_b.heat.winding_temperature_C - 20));

  input.voltage_b_V = 0.3;
  for (int tick = 1; tick <= 2000; ++tick) {
    step(p, state, input, 1e-4);
    const double exact_A = 0.3 / resistance * (1 - std::exp(-tick * 1e-4 * resistance / inductance_H));
    // What is left: the last eddy currents, some 10 us late.
    EXPECT_NEAR(observe(p, state, input).solenoid_b.current_A, exact_A, 3e-4 * 0.3 / resistance) << tick;
  }
}

TEST(PlantAnalytic, SpoolOnItsSpringSwingsAsADampedOscillator) {
  PlantParameters p = reference::smooth_plant();
  p.spring_b = {.preload_N = 9, .rate_N_per_m = 12000, .progressivity_per_m = 0};
  p.spool.washer_play_m = 1e-6;
  PlantInput input;
  PlantState state = plant_at_rest(p, input);
  state.position_m = 2.4e-3;

  const double mass_kg = p.spool.spool_mass_kg + 2 * p.spool.armature_mass_kg;
  const double viscosity_Pa_s =
      state.oil.density_kg_per_m3 * state.oil.viscosity_m2_per_s *
      (1 + 0.5 * state.pressure_P_Pa / (state.oil.bulk_modulus_Pa + 9 * 0.5 * state.pressure_P_Pa)) *
      std::exp(p.oil.pressure_viscosity_per_Pa * 0.5 * state.pressure_P_Pa);
  const double drag = viscosity_Pa_s * (pi * p.spool.diameter_m * p.spool.land_length_m / p.spool.clearance_m +
                                        2 * p.spool.armature_drag_m);
  const double decay = drag / (2 * mass_kg);
  const std::complex<double> root(-decay, std::sqrt(12000 / mass_kg - decay * decay));
  const double rest_m = -9.0 / 12000;  // where the spring would be without force
  int compared = 0;
  for (int tick = 1; state.position_m > 0.3e-3; ++tick) {
    step(p, state, input, 1e-4);
    const double t = tick * 1e-4;
    // x - rest = Re[c exp(root t)], with c from x(0) and v(0) = 0.
    const std::complex<double> c = (2.4e-3 - rest_m) * std::complex<double>(1, decay / -root.imag());
    const double exact_m = rest_m + (c * std::exp(root * t)).real();
    EXPECT_NEAR(state.position_m, exact_m, 2e-5 * 2.4e-3) << t;
    ++compared;
  }
  EXPECT_GT(compared, 30);
}

class SolenoidEnergy : public testing::TestWithParam<HysteresisKind> {};

TEST_P(SolenoidEnergy, IntoTheSolenoidIsHeatAndMechanicalWork) {
  PlantParameters p = reference::smooth_plant();
  p.arrangement = Arrangement::solenoid_bench;
  p.solenoid_b.hysteresis = {.kind = GetParam()};
  const double dt_s = 2e-5, period_s = 0.2;
  const double omega = 2 * pi / period_s;
  PlantInput input;
  input.motion = PrescribedMotion{.position_m = 1.2e-3};
  PlantState state = plant_at_rest(p, input);
  const Iron iron = iron_of(p.solenoid_b.iron, p.solenoid_b.hysteresis);
  const double iron_m3 = p.solenoid_b.circuit.iron_area_m2 * p.solenoid_b.circuit.iron_length_m;

  struct Power {
    double electric = 0, winding = 0, eddy = 0, mechanical = 0;
  };
  const auto power = [&] {
    const PlantOutput now = observe(p, state, input);
    const SolenoidOutput& b = now.solenoid_b;
    const double skin_A = b.eddy_current_A - state.solenoid_b.skin_current_A;
    return Power{input.voltage_b_V * b.current_A, b.resistance_ohm * b.current_A * b.current_A,
                 p.solenoid_b.eddy.core_resistance_ohm * b.eddy_current_A * b.eddy_current_A +
                     p.solenoid_b.eddy.skin_resistance_ohm * skin_A * skin_A,
                 b.magnetic_force_N * now.velocity_m_per_s};
  };
  Power sum;
  double iron_J = 0;
  const int ticks = static_cast<int>(std::lround(period_s / dt_s));
  for (int tick = 0; tick < 5 * ticks; ++tick) {
    const double t = tick * dt_s, end = t + dt_s;
    input.voltage_b_V = 4.5 + 3.5 * std::sin(omega * t);
    input.motion = PrescribedMotion{.position_m = 1.2e-3 - 0.9e-3 * std::cos(omega * end),
                                    .velocity_m_per_s = 0.9e-3 * omega * std::sin(omega * end)};
    const Power before = power();
    IronMemory memory = state.solenoid_b.iron;
    step(p, state, input, dt_s);
    if (tick < 4 * ticks) continue;  // let the transient die
    const Power after = power();
    sum.electric += 0.5 * dt_s * (before.electric + after.electric);
    sum.winding += 0.5 * dt_s * (before.winding + after.winding);
    sum.eddy += 0.5 * dt_s * (before.eddy + after.eddy);
    sum.mechanical += 0.5 * dt_s * (before.mechanical + after.mechanical);
    iron_J += iron_m3 * magnetise(iron, memory, state.solenoid_b.flux_Wb / p.solenoid_b.circuit.iron_area_m2);
  }
  EXPECT_GT(std::abs(sum.mechanical), 0.01);  // joules: the balance below is not one of zeros
  EXPECT_GT(iron_J, 1e-3);
  EXPECT_GT(sum.eddy, 1e-3);
  EXPECT_NEAR(sum.electric, sum.winding + sum.eddy + iron_J + sum.mechanical, 2e-4 * sum.electric);
}

INSTANTIATE_TEST_SUITE_P(Kinds, SolenoidEnergy,
                         testing::Values(HysteresisKind::jiles_atherton, HysteresisKind::preisach),
                         [](const auto& which) {
                           return which.param == HysteresisKind::preisach ? "Preisach" : "JilesAtherton";
                         });

TEST(PlantAnalytic, EddyLadderShowsItsSkinToFastChangesAndItsCoreToSlowOnes) {
  const Solenoid solenoid;
  const SolenoidConstants constants = solenoid_constants(solenoid, {});
  const auto at = [&](double skin_A) {
    std::array<double, solenoid_states> states{}, rate{};
    states[state_linkage] = 0.2;
    states[state_skin] = skin_A;
    const SolenoidRates rates = solenoid_rates(constants, {}, states, 1e-3, 0, rate);
    return std::pair{rates, rate[state_skin]};
  };
  const double core = solenoid.eddy.core_resistance_ohm, skin = solenoid.eddy.skin_resistance_ohm;
  const auto [fast, charging] = at(0);
  EXPECT_NEAR(fast.eddy_current_A * (core + skin) / fast.induced_V, 1, 1e-12);
  EXPECT_GT(charging, 0);
  double skin_A = 0;
  for (int i = 0; i < 200; ++i) skin_A = at(skin_A).first.eddy_current_A;  // until j_2 = j: nothing charges any more
  EXPECT_NEAR(at(skin_A).first.eddy_current_A * core / at(skin_A).first.induced_V, 1, 1e-9);
}

/// Runs with constant input until everything has settled.
PlantOutput settled(const PlantParameters& p, const PlantInput& input, double duration_s) {
  PlantState state = plant_at_rest(p, input);
  for (int tick = 0; tick < static_cast<int>(duration_s / 1e-4); ++tick) step(p, state, input, 1e-4);
  return observe(p, state, input);
}

TEST(PlantAnalytic, OrificeLoadPassesWhatBothEdgesPass) {
  PlantParameters p = reference::smooth_plant();
  p.load.kind = LoadKind::orifice;
  PlantInput input;
  input.voltage_b_V = 5;
  const PlantOutput out = settled(p, input, 1.0);
  const double drop_Pa = out.pressure_B_Pa - out.pressure_A_Pa;
  const double orifice = 0.7 * p.load.orifice_area_m2 * std::sqrt(2 * drop_Pa / out.oil_density_kg_per_m3);
  EXPECT_GT(out.flow_m3_per_s, 1e-4);
  EXPECT_NEAR((out.edge_PB.flow_m3_per_s - out.edge_BT.flow_m3_per_s) / orifice, 1, 1e-4);
  EXPECT_NEAR((out.edge_AT.flow_m3_per_s - out.edge_PA.flow_m3_per_s) / orifice, 1, 1e-4);
}

TEST(PlantAnalytic, CylinderMovesAtFlowOverArea) {
  PlantParameters p = reference::smooth_plant();
  p.load.kind = LoadKind::cylinder;
  p.load.cylinder_leakage_m3_per_s_Pa = 0;
  p.load.cylinder_stroke_m = 5;
  PlantInput input;
  input.voltage_b_V = 4;
  input.load_force_N = 2000;
  const PlantOutput out = settled(p, input, 1.0);
  EXPECT_GT(out.cylinder_velocity_m_per_s, 0.05);
  const double into_B = out.edge_PB.flow_m3_per_s - out.edge_BT.flow_m3_per_s;
  EXPECT_NEAR(into_B / p.load.piston_area_B_m2, out.cylinder_velocity_m_per_s, 2e-3 * out.cylinder_velocity_m_per_s);
  // Balance of forces on the piston.
  EXPECT_NEAR(out.pressure_B_Pa * p.load.piston_area_B_m2 - out.pressure_A_Pa * p.load.piston_area_A_m2,
              2000 + p.load.cylinder_drag_N_s_per_m * out.cylinder_velocity_m_per_s, 5);
}

TEST(PlantAnalytic, MotorTurnsAtFlowOverDisplacement) {
  PlantParameters p = reference::smooth_plant();
  p.arrangement = Arrangement::axial_force_bench;  // which holds the spool
  p.load.kind = LoadKind::motor;
  p.load.motor_leakage_m3_per_s_Pa = 0;
  PlantInput input;
  input.motion = PrescribedMotion{.position_m = 1e-3};
  const PlantOutput out = settled(p, input, 1.5);
  const double speed_rad_per_s = out.cylinder_velocity_m_per_s;
  EXPECT_GT(speed_rad_per_s, 5);
  const double into_B = out.edge_PB.flow_m3_per_s - out.edge_BT.flow_m3_per_s;
  EXPECT_NEAR(into_B / p.load.motor_displacement_m3_per_rad, speed_rad_per_s, 2e-3 * speed_rad_per_s);
  // Balance of torques on the shaft.
  EXPECT_NEAR((out.pressure_B_Pa - out.pressure_A_Pa) * p.load.motor_displacement_m3_per_rad,
              p.load.motor_torque_N_m + p.load.motor_drag_N_m_s * speed_rad_per_s, 0.1);
}

TEST(PlantAnalytic, AReturnLineToTankKeepsTheReturnFlowsForceOffTheSpool) {
  for (const LoadKind kind : {LoadKind::orifice, LoadKind::motor}) {
    PlantParameters p = reference::smooth_plant();
    p.load.kind = kind;
    PlantInput input;
    input.voltage_b_V = 5;
    const PlantOutput through_valve = settled(p, input, 1.0);
    p.load.return_to_tank = true;
    const PlantOutput to_tank = settled(p, input, 1.0);
    EXPECT_GT(through_valve.edge_AT.flow_m3_per_s, 1e-4);
    EXPECT_EQ(to_tank.edge_AT.flow_m3_per_s, 0);
    EXPECT_EQ(to_tank.pressure_A_Pa, p.supply.tank_pressure_Pa);
    EXPECT_GT(to_tank.flow_m3_per_s, through_valve.flow_m3_per_s) << "one resistance less in the way";
  }
}

TEST(Plant, BothSolenoidsPullAlikeIntoTheirOwnDirection) {
  const PlantParameters p;
  PlantInput to_b, to_a;
  to_b.held_pressure_difference_Pa = to_a.held_pressure_difference_Pa = 50e5;
  to_b.voltage_b_V = 5;
  to_a.voltage_a_V = 5;
  const PlantOutput b = settled(p, to_b, 0.3), a = settled(p, to_a, 0.3);
  EXPECT_GT(b.position_m, 0.5e-3);
  EXPECT_NEAR(a.position_m, -b.position_m, 1e-9);
  EXPECT_NEAR(a.flow_m3_per_s, b.flow_m3_per_s, 1e-9);
  EXPECT_NEAR(a.flow_force_N, -b.flow_force_N, 1e-6);
  EXPECT_GT(b.edge_PB.flow_m3_per_s, 10 * b.edge_PA.flow_m3_per_s);
  EXPECT_GT(a.edge_PA.flow_m3_per_s, 10 * a.edge_PB.flow_m3_per_s);
}

TEST(Plant, HalvingTheStepChangesNothingVisible) {
  // The whole valve with friction, hysteresis and ripple, moved through its stroke: 0.1 % of full scale is a line's
  // width.
  const PlantParameters p;
  PlantParameters finer = p;
  finer.integration.longest_step_s = 0.5 * p.integration.longest_step_s;
  finer.integration.shortest_step_s = 0.5 * p.integration.shortest_step_s;
  finer.integration.tolerance = 0.125 * p.integration.tolerance;
  PlantState one = plant_at_rest(p, reference::smooth_drive(0)), two = one;
  reference::TrajectoryError error;
  for (int tick = 0; tick < 3000; ++tick) {
    const PlantInput input = reference::smooth_drive(tick * 1e-4);
    step(p, one, input, 1e-4);
    step(finer, two, input, 1e-4);
    error.compare(observe(p, one, input), observe(finer, two, input));
  }
  EXPECT_LT(error.largest(), 1e-3);
}

TEST(Plant, SupplyRipplesByItsAmplitudeAtItsFrequency) {
  PlantParameters p;
  p.load.ideal_hold = true;
  PlantInput input;
  input.held_pressure_difference_Pa = 60e5;
  PlantState state = plant_at_rest(p, input);
  double lowest = 1e9, highest = 0;
  int rises = 0;
  bool above = false;
  const int ticks = 4000;
  for (int tick = 0; tick < ticks; ++tick) {
    step(p, state, input, 1e-4);
    const double pressure = observe(p, state, input).pressure_P_Pa;
    lowest = std::min(lowest, pressure);
    highest = std::max(highest, pressure);
    const bool now_above = pressure > 64e5;
    rises += now_above && !above;
    above = now_above;
  }
  EXPECT_NEAR(highest - lowest, 2 * p.supply.ripple_Pa, 0.02 * p.supply.ripple_Pa);
  EXPECT_NEAR(rises, p.supply.ripple_Hz * ticks * 1e-4, 1.01);
}

TEST(Plant, BreakAwayTakesMoreForceTheLongerTheSpoolHasRested) {
  const PlantParameters p;
  const auto break_away_N = [&](double rest_s) {
    PlantInput input;
    input.held_pressure_difference_Pa = 60e5;
    input.voltage_b_V = 5;
    PlantState state = plant_at_rest(p, input);
    for (int tick = 0; tick < 3000 + static_cast<int>(rest_s / 1e-4); ++tick) step(p, state, input, 1e-4);
    const double rest_m = state.position_m;
    double largest_N = 0;
    for (int tick = 0; state.position_m < rest_m + 30e-6 && tick < 30000; ++tick) {
      input.voltage_b_V += 1e-4;  // 1 V/s
      step(p, state, input, 1e-4);
      largest_N = std::max(largest_N, observe(p, state, input).spool_friction_force_N);
    }
    EXPECT_GT(state.position_m, rest_m + 30e-6) << "never broke away";
    return largest_N;
  };
  const double soon_N = break_away_N(0.1), late_N = break_away_N(6);
  EXPECT_GT(soon_N, 2);
  EXPECT_GT(late_N, 1.3 * soon_N);
}

}  // namespace
}  // namespace spoolflow::rig
