/// From coil current to magnetising current, on a coil whose flux is known.
#include "spoolflow/sensor/coil.hpp"

#include <numbers>

#include <gtest/gtest.h>

#include "spoolflow/sensor/signals/current_guard.hpp"
#include "tests/sensor/closed_form_valve.hpp"

namespace spoolflow::sensor {
namespace {

/// Largest errors against the truth after the first `settle_s`.
struct CoilErrors {
  double magnetising_A = 0, flux_Wb = 0, rate_V = 0;
};

/// The coil of a valve whose spool stays and whose pressure makes the current swing.
CoilErrors errors(double frequency_Hz, double sample_step_s, double settle_s = 0) {
  const auto run =
      ClosedFormRun(closed_form,
                    [&](double time_s) {
                      const double swing = std::sin(2 * std::numbers::pi * frequency_Hz * time_s);
                      return ValveInstant{.position_m = 1.2e-3, .pressure_difference_Pa = 45e5 + 30e5 * swing};
                    },
                    {.position_noise_m = 0, .current_noise_A = 0})
          .sampled(std::max(4 / frequency_Hz, settle_s + 1 / frequency_Hz), sample_step_s);
  const ActuatorParameters<double> actuator = closed_form_actuator<double>(closed_form);
  CoilState<double> state{};
  CoilErrors out;
  double time_s = 0;
  for (std::size_t k = 0; k < run.size(); ++k) {
    const Cell<double> position =
        locate<flux_map_positions>(actuator.coil.flux_linkage.map.column_axis, run[k].truth.position_m);
    follow_current(actuator.coil, state, {sample_step_s, run[k].measured.current_A}, position, k == 0);
    time_s += sample_step_s;
    if (time_s < settle_s) continue;
    out.magnetising_A = std::max(out.magnetising_A, std::abs(state.magnetising_current_A - run[k].magnetising_A));
    out.flux_Wb = std::max(out.flux_Wb, std::abs(state.hysteresis.flux - run[k].flux_Wb));
  }
  return out;
}

TEST(Coil, TakesHysteresisAndEddyCurrentsOffASlowCurrent) {
  for (const double step_s : {50e-6, 200e-6, 1e-3, 5e-3}) {
    const CoilErrors slow = errors(1, step_s, 1.1);
    // The current swings by 1.3 A, hysteresis and eddy currents by 0.1 A.
    EXPECT_LT(slow.magnetising_A, 5e-3) << step_s;
    EXPECT_LT(slow.flux_Wb, 1e-3) << step_s;
  }
}

TEST(Coil, FollowsAFluxThatEddyCurrentsHoldBack) {
  // 100 Hz, as dither: eddy currents of up to 0.3 A, ten samples a period at 1 kHz.
  EXPECT_LT(errors(100, 50e-6, 0.05).magnetising_A, 0.01);
  EXPECT_LT(errors(100, 1e-3, 0.05).magnetising_A, 0.05);
}

/// The magnetising current that meets the current balance of a step from `before`, by bisection.
double balanced_current_A(const Coil<double>& coil, const CoilState<double>& before, const CoilStep<double>& step,
                          const Cell<double>& position) {
  const double weight = end_weight(before.time_constant_s / step.time_step_s);
  double low_A = -1, high_A = 4;
  for (int k = 0; k < 60; ++k) {
    const double middle_A = (low_A + high_A) / 2;
    const auto& map = coil.flux_linkage.map;
    const double flux_Wb = map.at(locate<flux_map_currents>(map.row_axis, middle_A), position).value;
    const double static_A = middle_A + hysteresis_at(coil.hysteresis, before.hysteresis, flux_Wb).value;
    const double eddy_A = coil.eddy_currents.at((flux_Wb - before.hysteresis.flux) / step.time_step_s).current_A;
    const bool more = weight * static_A + (1 - weight) * before.static_current_A + eddy_A < step.current_A;
    (more ? low_A : high_A) = middle_A;
  }
  return (low_A + high_A) / 2;
}

TEST(Coil, MeetsTheBalanceOfItsCurrentsThoughDitherTurnsRoundBetweenTwoSamples) {
  Coil<double> coil = closed_form_actuator<double>(closed_form).coil;
  coil.eddy_currents = {.classical_A_per_V = 0.005, .excess_A_per_rootV = 0.015, .smallest_rate_V = 0.01};
  const Cell<double> position = locate<flux_map_positions>(coil.flux_linkage.map.column_axis, 1.2e-3);
  for (const double frequency_Hz : {90.0, 140.0, 210.0}) {
    CoilState<double> state{};
    double square_A2 = 0;
    int samples = 0;
    for (double time_s = 0; time_s < 1; time_s += 2e-3, ++samples) {
      const double turns = frequency_Hz * time_s;
      const CoilStep<double> step{2e-3, 1.2 + (turns - std::floor(turns) < 0.5 ? 0.1 : -0.1)};
      const CoilState<double> before = state;
      follow_current(coil, state, step, position, samples == 0);
      if (samples == 0) continue;
      const double wrong_A = state.magnetising_current_A - balanced_current_A(coil, before, step, position);
      square_A2 += wrong_A * wrong_A;
    }
    EXPECT_LT(std::sqrt(square_A2 / samples), 0.05 * 0.1) << frequency_Hz;
  }
}

TEST(Coil, AMotionChangesTheCurrentByWhatKeepsTheFlux) {
  const Coil<double> coil = closed_form_actuator<double>(closed_form).coil;
  const auto& map = coil.flux_linkage.map;
  constexpr double current_A = 1.1, position_m = 1.21e-3, travel_m = 2e-5;
  const double flux_Wb = map.at(current_A, position_m).value;
  double low_A = 0, high_A = 2;
  for (int k = 0; k < 50; ++k) {
    const double middle_A = (low_A + high_A) / 2;
    (map.at(middle_A, position_m + travel_m).value < flux_Wb ? low_A : high_A) = middle_A;
  }
  const double change_A = std::abs(low_A - current_A);
  EXPECT_GT(change_A, 1e-3);
  EXPECT_NEAR(moved_current_A(coil, current_A, position_m, travel_m), change_A, 0.05 * change_A);
  EXPECT_NEAR(moved_current_A(coil, current_A, position_m, -travel_m), change_A, 0.05 * change_A);
}

TEST(CurrentGuard, AcceptsALeapThatTheSpoolsMotionExplains) {
  const CurrentLimits<double> limits{0.2, 490};  // 0.69 A in a millisecond
  const CurrentStep<double> current{1.9, 1.15};
  EXPECT_FALSE(is_held(limits, current, 1e-3, 0, [](double fastest_A) { return fastest_A + 0.1; }));
  EXPECT_TRUE(is_held(limits, current, 1e-3, 0, [](double fastest_A) { return fastest_A + 0.02; }));
}

TEST(CurrentGuard, RefusesALeapThatTheVoltageDidNotDriveThoughThisCoilCouldDoIt) {
  const CurrentLimits<double> limits{0.2, 1600};  // 24 V at 15 mH
  const CurrentStep<double> current{0.9, 1.9};
  const CoilResistance<double> coil{.resistance_Ohm = 4};
  const auto held = [&](double before_V, double now_V, double step_s = 1e-3) {
    return is_held(limits, current, step_s, 0, [&](double fastest_A) {
      return fastest_A * driven_share(coil, {current.before_A, now_V, before_V, step_s}, 24.0, 2.5);
    });
  };
  EXPECT_TRUE(held(3.6, 3.8));
  EXPECT_FALSE(held(3.6, 24));
  EXPECT_FALSE(held(24, 3.8));
  EXPECT_FALSE(held(24, -24));
  EXPECT_FALSE(held(3.6, std::nan("")));
  EXPECT_FALSE(held(std::nan(""), 3.6));
  EXPECT_FALSE(held(3.6, 3.8, 3e-3));  // what a slow recorder calls the voltage is seldom its mean
}

TEST(Coil, KnowsNothingOfItsHistoryAtFirst) {
  // Demagnetised and brought slowly to its first current: where the truth began likewise nothing is wrong, and what a
  // reversal before the start would have left is within the coercive current.
  EXPECT_LT(errors(1, 1e-3).magnetising_A, 0.04);
}

TEST(EndWeight, IsTheTrapezoidalRulesForSlowFluxAndImplicitEulersForFast) {
  EXPECT_NEAR(end_weight(100.0), 0.5, 1e-3);
  EXPECT_DOUBLE_EQ(end_weight(0.0), 1);
  for (const double a : {0.1, 0.3, 1.0, 3.0}) EXPECT_NEAR(end_weight(a), 1 / (1 - std::exp(-1 / a)) - a, 0.04) << a;
}

}  // namespace
}  // namespace spoolflow::sensor
