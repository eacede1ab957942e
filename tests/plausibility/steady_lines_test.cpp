/// What shakes the spool and what beats in the current, on signals of which both are known.
#include "spoolflow/plausibility/steady_lines.hpp"

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace spoolflow::plausibility {
namespace {

using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double noise_m = 0.7e-6;

double sine(double frequency_Hz, double time_s) {
  return std::sin(2 * std::numbers::pi * frequency_Hz * time_s);
}

/// A valve that strokes at random with noise on position and current, and what comes to them, of `rate_Hz` for 40 s.
SteadyLines run(double rate_Hz, const std::function<double(double)>& position_m,
                const std::function<double(double)>& current_A) {
  std::mt19937 engine(7);
  std::normal_distribution<double> noise(0, 1);
  std::vector<double> time_s, position, current;
  double target_m = 1e-3, stroke_m = 0;
  const auto samples = static_cast<int>(40 * rate_Hz);
  for (int k = 0; k < samples; ++k) {
    const double now_s = k / rate_Hz;
    if (k % static_cast<int>(rate_Hz / 3) == 0) target_m = 1e-3 + 3e-4 * noise(engine);
    stroke_m += (target_m - stroke_m) * 30 / rate_Hz;
    time_s.push_back(now_s);
    position.push_back(stroke_m + noise_m * noise(engine) + position_m(now_s));
    current.push_back(1 + 500 * (stroke_m - 1e-3) + 1.5e-3 * noise(engine) + current_A(now_s));
  }
  SteadyLines out;
  out.position.take(time_s, position);
  out.current[0].take(time_s, current);
  out.largest_current_A[0] = 2;
  return out;
}

const std::function<double(double)> no_line = [](double) { return 0.0; };

TEST(SteadyLines, AValveThatWorksHasNone) {
  EXPECT_THAT(steady_line_findings(run(1000, no_line, no_line), {noise_m}), IsEmpty());
}

TEST(SteadyLines, AMachineThatShakesItsValveIsNamedWithFrequencyAndAmplitudeAtAnySamplingRate) {
  for (const double rate_Hz : {500.0, 1000.0, 3000.0}) {
    const auto shaken = [](double now_s) { return 2e-6 * sine(35.2, now_s); };
    const SteadyLines seen = run(rate_Hz, shaken, no_line);
    EXPECT_THAT(steady_line_findings(seen, {noise_m}), ElementsAre(HasSubstr("position shakes at 35.2 Hz by")))
        << rate_Hz;
    const auto line = seen.position.median().line(15, 120, {});
    ASSERT_TRUE(line) << rate_Hz;
    EXPECT_NEAR(line->amplitude, 2e-6, 0.4e-6) << rate_Hz;
  }
}

TEST(SteadyLines, DitherAndWhereSamplingFoldsItsHarmonicsAreNone) {
  const auto dither = [](double now_s) {  // a square wave: 117 Hz folds to 64, 53 and 11 Hz
    return sine(117, now_s) > 0 ? 0.1 : -0.1;
  };
  const auto follows = [&](double now_s) { return 2e-5 * dither(now_s); };
  EXPECT_THAT(steady_line_findings(run(1000, follows, dither), {noise_m}), IsEmpty());
  const auto shaken = [&](double now_s) { return follows(now_s) + 5e-6 * sine(35.2, now_s); };
  EXPECT_THAT(steady_line_findings(run(1000, shaken, dither), {noise_m}), ElementsAre(HasSubstr("shakes at 35.2 Hz")));
}

TEST(SteadyLines, APwmThatIsSampledAtInstantsIsNamedWithWhatToDeclare) {
  const auto beat = [](double now_s) { return 0.04 * sine(19, now_s); };
  EXPECT_THAT(steady_line_findings(run(1000, no_line, beat), {noise_m}),
              ElementsAre(AllOf(HasSubstr("current beats at 19.0 Hz by"), HasSubstr("pwm_ripple_percent = 3.9"))));
}

/// A coil of 3 Ohm whose current strokes at random, of which so much of what beats in it at 3.1 Hz has its voltage.
SteadyLines beating(double driven_share) {
  std::mt19937 engine(7);
  std::normal_distribution<double> noise(0, 1);
  std::vector<double> time_s, current, voltage;
  double target_A = 1, stroke_A = 1;
  for (int k = 0; k < 40'000; ++k) {
    if (k % 333 == 0) target_A = 1 + 0.15 * noise(engine);
    stroke_A += (target_A - stroke_A) * 0.03;
    time_s.push_back(1e-3 * k);
    const double beat_A = 0.1 * sine(3.1, time_s.back());
    current.push_back(stroke_A + beat_A + 1.5e-3 * noise(engine));
    voltage.push_back(3 * (stroke_A + driven_share * beat_A) + 0.01 * noise(engine));
  }
  SteadyLines out;
  out.current[0].take(time_s, current);
  out.voltage[0].take(time_s, voltage);
  out.largest_current_A[0] = 2;
  return out;
}

TEST(SteadyLines, APwmThatBeatsSlowlyIsNamedByTheVoltageThatDoesNotDriveIt) {
  EXPECT_THAT(steady_line_findings(beating(0), {noise_m, {3, 3}}),
              ElementsAre(AllOf(HasSubstr("current beats at 3.1 Hz by"), HasSubstr("without a voltage that drives it"),
                                HasSubstr("pwm_ripple_percent = "))));
  EXPECT_THAT(steady_line_findings(beating(1), {noise_m, {3, 3}}), IsEmpty()) << "the valve works at 3.1 Hz";
  EXPECT_THAT(steady_line_findings(beating(0), {noise_m}), IsEmpty()) << "the coil's resistance is not known";
}

/// Keeps of each sample what one pole of a low-pass leaves of it, twice.
struct LowPass {
  double corner_Hz, rate_Hz;
  double first = 0, second = 0;

  double operator()(double value) {
    const double share = 1 - std::exp(-2 * std::numbers::pi * corner_Hz / rate_Hz);
    first += share * (value - first);
    second += share * (first - second);
    return second;
  }
};

/// Dithered; position and current each behind a low-pass of their own; infinite: none.
SteadyLines dithered_behind(double position_Hz, double current_Hz, double noise_share = 1) {
  std::mt19937 engine(7);
  std::normal_distribution<double> noise(0, noise_share);
  LowPass of_position{position_Hz, 1000}, of_current{current_Hz, 1000};
  std::vector<double> time_s, position, current;
  for (int k = 0; k < 40'000; ++k) {
    time_s.push_back(1e-3 * k);
    const double dither = sine(140, time_s.back());
    position.push_back(of_position(1e-3 + 3e-6 * dither + noise_m * noise(engine)));
    current.push_back(of_current(1 + 0.15 * dither + 1.5e-3 * noise(engine)));
  }
  SteadyLines out;
  out.position.take(time_s, position);
  out.current[0].take(time_s, current);
  out.largest_current_A[0] = 1.8;
  return out;
}

TEST(NoisyCurrent, IsNamedWithItsNoiseAtAnySamplingRate) {
  for (const double rate_Hz : {1000.0, 3000.0}) {
    std::mt19937 engine(11);
    std::normal_distribution<double> noise_A(0, 0.012 * std::sqrt(rate_Hz / 500));
    EXPECT_THAT(noisy_current(run(rate_Hz, no_line, [&](double) { return noise_A(engine); })),
                AllOf(AnyOf(HasSubstr("noise of 11 mA as its mean over 2 ms"), HasSubstr("noise of 12 mA as its mean")),
                      HasSubstr("0.6 % of its largest value")))
        << rate_Hz;
  }
}

TEST(NoisyCurrent, IsNoneOfASoundCoilUnderDitherOrWithSpikes) {
  EXPECT_THAT(noisy_current(run(1000, no_line, no_line)), IsEmpty());
  EXPECT_THAT(noisy_current(run(1000, no_line, [](double now_s) { return 0.2 * sine(80, now_s); })), IsEmpty());
  std::mt19937 engine(13);
  std::bernoulli_distribution strikes(1e-3);
  EXPECT_THAT(noisy_current(run(1000, no_line, [&](double) { return strikes(engine) ? 1.0 : 0.0; })), IsEmpty());
}

TEST(LowPass, OfTheRecorderIsNamedInThePositionOrInTheCurrentAlone) {
  constexpr double open = 1e9;
  EXPECT_THAT(low_pass_finding(dithered_behind(open, open), noise_m), IsEmpty());
  for (const double corner_Hz : {20.0, 50.0})
    EXPECT_THAT(low_pass_finding(dithered_behind(corner_Hz, corner_Hz), noise_m),
                AllOf(HasSubstr("position holds no noise beyond 150 Hz"), HasSubstr("dither"), HasSubstr("low-pass")));
  EXPECT_THAT(low_pass_finding(dithered_behind(open, 20), noise_m), HasSubstr("current holds no noise beyond 150 Hz"));
}

TEST(LowPass, IsNoQuieterSensorNorAStrokingValve) {
  EXPECT_THAT(low_pass_finding(dithered_behind(1e9, 1e9, 0.05), noise_m), IsEmpty());
  EXPECT_THAT(low_pass_finding(run(1000, no_line, no_line), noise_m), IsEmpty());
}

TEST(SteadyLines, OfARunOfAnHourAreThoseOfAllItsTime) {
  MedianSpectrum spectrum;
  for (int block = 0; block < 36; ++block) {
    std::vector<double> time_s, position_m;
    for (int k = 0; k < 50000; ++k) {
      time_s.push_back((50000 * block + k) / 500.0);
      position_m.push_back(2e-6 * sine(35.2, time_s.back()) + 1e-7 * std::sin(1.0 * k * k));
    }
    spectrum.take(time_s, position_m);
  }
  const auto line = spectrum.median().line(15, 120, {});
  ASSERT_TRUE(line);
  EXPECT_NEAR(line->frequency_Hz, 35.2, 0.05);
}

TEST(SteadyLines, AMissingValueCostsItsOwnPieceAlone) {
  const auto sometimes_missing = [](double now_s) {
    return std::fmod(now_s, 9) < 1e-4 ? std::nan("") : 2e-6 * sine(35.2, now_s);
  };
  EXPECT_THAT(steady_line_findings(run(1000, sometimes_missing, no_line), {noise_m}),
              ElementsAre(HasSubstr("35.2 Hz by")));
}

}  // namespace
}  // namespace spoolflow::plausibility
