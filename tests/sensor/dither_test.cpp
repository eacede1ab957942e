/// Dither found from the current, and what it shows of friction.
#include "spoolflow/sensor/signals/dither.hpp"

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "spoolflow/sensor/observer.hpp"
#include "tests/sensor/valve_course.hpp"

namespace spoolflow::sensor {
namespace {

constexpr double dithered_coil_A = 2.5;
using Wave = double (*)(double turns);

double sine(double turns) {
  return std::sin(2 * std::numbers::pi * turns);
}
double square(double turns) {
  return turns - std::floor(turns) < 0.5 ? 1 : -1;
}
double triangle(double turns) {
  return 1 - 4 * std::abs(turns - std::floor(turns) - 0.5);
}

struct Heard {
  double first_s = -1;  ///< -1: never
  double last_s = -1;
  int samples = 0, present = 0;
  double frequency_Hz = 0, amplitude_A = 0;
};

/// What is found in a current, mean over each sample, with the noise of a good measurement.
Heard listen_to(const std::function<double(double)>& current_A, double step_s, double duration_s) {
  std::mt19937 generator(5);
  std::normal_distribution<double> noise_A(0, 2e-3);
  DitherState<double> state{};
  begin(state, current_A(0));
  Heard out;
  for (double time_s = step_s; time_s < duration_s; time_s += step_s) {
    double mean_A = 0;
    constexpr int fine = 20;
    for (int k = 0; k < fine; ++k) mean_A += current_A(time_s - step_s * (k + 0.5) / fine) / fine;
    const Dither<double> dither = follow_dither(state, mean_A + noise_A(generator), dithered_coil_A, step_s);
    ++out.samples;
    if (!dither.present) continue;
    ++out.present;
    if (out.first_s < 0) out.first_s = time_s;
    out.last_s = time_s;
    out.frequency_Hz += dither_frequency_Hz(state);
    out.amplitude_A += dither_amplitude_A(state);
  }
  out.frequency_Hz /= std::max(1, out.present);
  out.amplitude_A /= std::max(1, out.present);
  return out;
}

TEST(Dither, IsFoundFromTheCurrentWhateverItsShapeFrequencyAndSize) {
  for (const Wave wave : {sine, square, triangle}) {
    for (const double frequency_Hz : {80.0, 110.0, 140.0, 200.0}) {
      for (const double amplitude_A : {0.08, 0.25}) {
        const auto current_A = [&](double time_s) {
          const bool dithers = time_s > 0.2 && time_s < 0.8;
          return 1.2 + 0.2 * time_s + (dithers ? amplitude_A * wave(frequency_Hz * time_s) : 0);
        };
        for (const double step_s : {1e-4, 1e-3}) {
          const Heard heard = listen_to(current_A, step_s, 1.0);
          EXPECT_GT(heard.first_s, 0.2) << frequency_Hz << ' ' << step_s;
          EXPECT_LT(heard.first_s, 0.2 + 5 / frequency_Hz + 3 * step_s) << frequency_Hz << ' ' << step_s;
          EXPECT_LT(heard.last_s, 0.8 + 1.2 * longest_dither_period_s) << frequency_Hz << ' ' << step_s;
          EXPECT_GT(heard.present * step_s, 0.5) << frequency_Hz << ' ' << step_s;
          EXPECT_NEAR(heard.frequency_Hz, frequency_Hz, 0.1 * frequency_Hz) << step_s;
          EXPECT_NEAR(heard.amplitude_A, amplitude_A, 0.35 * amplitude_A) << frequency_Hz << ' ' << step_s;
        }
      }
    }
  }
}

TEST(Dither, IsNotFoundInNoiseRampsStepsOrTheHuntingOfAPositionControl) {
  const std::vector<std::function<double(double)>> currents{
      [](double) { return 1.0; }, [](double time_s) { return 0.5 + 0.4 * time_s; },
      [](double time_s) { return std::fmod(time_s, 0.3) < 0.15 ? 0.8 : 1.6; },
      [](double time_s) { return 1.2 + 0.3 * std::sin(2 * std::numbers::pi * 8 * time_s); }};
  for (const auto& current_A : currents) EXPECT_EQ(listen_to(current_A, 1e-3, 3).present, 0);
}

TEST(Dither, SwingOfFrictionFollowsFromItsExtremesAndItsMiddle) {
  DitherState<double> state{};
  FrictionSwingState<double> swing{};
  begin(state, 1.0);
  int settled = 0;
  for (double time_s = 0; time_s < 0.5; time_s += 1e-3) {
    const double wave = sine(140 * time_s);
    const Dither<double> dither = follow_dither(state, 1.0 + 0.1 * wave, dithered_coil_A, 1e-3);
    const FrictionSwing<double> found = follow_swing(swing, dither, 1.5 + 3 * wave);
    if (time_s < 0.2) continue;
    settled += found.settled ? 1 : 0;
    EXPECT_NEAR(found.middle_N, 1.5, 0.25);
    EXPECT_NEAR(found.half_swing_N, 3, 0.3);
  }
  EXPECT_EQ(settled, 300);
}

TEST(Dither, SwingIsRightInTheMeanThoughSamplesMissItsPeaks) {
  for (const double step_s : {1e-3, 2e-3})
    for (const double frequency_Hz : {91.0, 117.0, 143.0, 171.0}) {
      DitherState<double> state{};
      FrictionSwingState<double> swing{};
      begin(state, 1.0);
      double half_N = 0, square_N2 = 0, allowed_N2 = 0;
      int samples = 0;
      for (double time_s = 0; time_s < 2; time_s += step_s) {
        const double wave = sine(frequency_Hz * time_s);
        const Dither<double> dither = follow_dither(state, 1.0 + 0.1 * wave, dithered_coil_A, step_s);
        const FrictionSwing<double> found = follow_swing(swing, dither, 1.5 + 3 * wave);
        if (time_s < 0.2) continue;
        ++samples;
        half_N += found.half_swing_N;
        square_N2 += squared(found.middle_N - 1.5);
        allowed_N2 += squared(missed_middle * squared(dither.sample_per_period) * found.half_swing_N);
      }
      EXPECT_NEAR(half_N / samples, 3, 0.27) << frequency_Hz << ' ' << step_s;
      EXPECT_LT(square_N2, allowed_N2) << frequency_Hz << ' ' << step_s;
    }
}

TEST(Dither, LeavesABreakAwayAfterALongRestLessSure) {
  const FrictionParameters<double> friction{.ageing_ratio = 3, .ageing_s = 1};
  ForceBalance<double> balance{};
  balance.spool_friction_N = 4;
  balance.noise_N = 0.2;
  balance.direction = 1;
  const auto noise_N = [&](bool dithered, double rested_s) {
    balance.dithered = dithered;
    balance.resting.rested_s = rested_s;
    return breakaway_innovation(friction, balance, 0.0).noise_N;
  };
  EXPECT_DOUBLE_EQ(noise_N(false, 9), 0.2);
  EXPECT_DOUBLE_EQ(noise_N(true, 0), 0.2);
  EXPECT_NEAR(noise_N(true, 9), 0.25 * 0.9 * 2 * 4, 0.02);  // a quarter of what nine tenths of the ageing add
}

/// The slip that a peak of the force beyond friction makes, integrated: its way [m].
double slip_m(double mass_kg, double half_swing_N, double frequency_Hz, double excess_N) {
  const double w = 2 * std::numbers::pi * frequency_Hz;
  double velocity = 0, way_m = 0;
  constexpr double step_s = 1e-7;
  for (double time_s = -std::sqrt(2 * excess_N / half_swing_N) / w; time_s < 0 || velocity > 0; time_s += step_s) {
    velocity += (excess_N - half_swing_N * w * time_s * w * time_s / 2) / mass_kg * step_s;
    way_m += velocity * step_s;
  }
  return way_m;
}

TEST(Dither, ForceExceedsFrictionByWhatTheSlipOfThePeriodAsksOfTheMass) {
  for (const double excess_N : {0.1, 0.4, 0.8})
    for (const double frequency_Hz : {80.0, 140.0, 220.0}) {
      const double way_m = slip_m(0.12, 3, frequency_Hz, excess_N);
      EXPECT_NEAR(slip_excess_N(0.12, 3.0, way_m, 1 / frequency_Hz), excess_N, 0.01 * excess_N);
    }
}

/// The valve in closed form opens, rests, and the supply moves while it rests; friction swings by `half_swing` of its
/// limits at 120 Hz about where it stood.
Judgement at_rest_beside_a_moving_supply(double half_swing) {
  Course course({.position_m = 0.4e-3, .pressure_difference_Pa = 50e5});
  course.rest(0.1, 1).slide(1.6e-3, 1).rest(0.3, 0).rest(0.5, 0, 58e5).rest(1, 0);
  const auto dithered = [&](double time_s) {
    ValveInstant now = course(time_s);
    const bool slides = time_s > 0.1 && time_s < 1.1;
    now.friction_share += half_swing * (slides ? sine(120 * time_s) - 1 : sine(120 * time_s));
    return now;
  };
  const ObserverParameters<double> parameters = closed_form_observer<double>(closed_form);
  ObserverState<double> state{};
  Judgement out;
  double time_s = 0;
  for (const ValveSample& sample : ClosedFormRun(closed_form, dithered).sampled(course.end_s(), 1e-3)) {
    time_s += 1e-3;
    const Estimate<double>& answer = step(parameters, state, sample.measured);
    if (time_s < 2.1) continue;
    out.add(answer, sample.flow_m3_per_s, closed_form.full_scale_m3_per_s());
    EXPECT_EQ(has(answer.status, Status::dithered), half_swing > 0) << time_s;
  }
  return out;
}

TEST(Dither, MakesTheRestingSpoolSee) {
  const Judgement blind = at_rest_beside_a_moving_supply(0);
  const Judgement sees = at_rest_beside_a_moving_supply(0.95);
  EXPECT_LT(sees.largest, 0.5 * blind.largest);
  EXPECT_LT(sees.rms(), 0.2 * blind.rms());
  EXPECT_GT(blind.coverage(), 0.93);
  EXPECT_GT(sees.coverage(), 0.93);
}

}  // namespace
}  // namespace spoolflow::sensor
