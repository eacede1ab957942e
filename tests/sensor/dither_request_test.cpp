/// Dither is requested where the band is too wide, within the limits that were given.
#include "spoolflow/sensor/dither_request.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "spoolflow/sensor/whole_valve/whole_dither_request.hpp"

namespace spoolflow::sensor {
namespace {

template <class T>
constexpr DitherRequestParameters<T> listening_limits{T(1e-5), T(0.1), T(0.3), T(125), T(0.5), T(0.2)};
constexpr double rests_open_m = 1e-3;
constexpr double wide_m3_per_s = 3e-5;    ///< half width
constexpr double narrow_m3_per_s = 5e-6;  ///< half width

/// An observer whose state says what a test wants, sampled at 1 kHz.
template <class T>
struct Requests {
  DitherRequestParameters<T> limits = listening_limits<T>;
  DitherRequestState<T> memory{};
  ObserverParameters<T> valve{};
  ObserverState<T> observer{};
  DitherRequest<T> request{};

  Requests() {
    valve.closed_below_m = T(0.2e-3);
    observer.started = true;
    observer.position.last_m = T(rests_open_m);
    band(wide_m3_per_s);
  }
  void band(double half_width_m3_per_s) {
    observer.last.flow_m3_per_s = T(1e-4);
    observer.last.flow_lower_m3_per_s = T(1e-4 - half_width_m3_per_s);
    observer.last.flow_upper_m3_per_s = T(1e-4 + half_width_m3_per_s);
  }
  /// Goes on for so long; returns the largest amplitude asked for [A].
  double run(double duration_s) {
    double largest_A = 0;
    for (int k = 0; k < std::lround(duration_s / 1e-3); ++k) {
      request = request_dither(limits, memory, valve, observer, T(1e-3));
      EXPECT_EQ(request.active, request.amplitude_A > T(0));
      EXPECT_EQ(request.frequency_Hz, request.active ? limits.frequency_Hz : T(0));
      largest_A = std::max(largest_A, static_cast<double>(request.amplitude_A));
    }
    return largest_A;
  }
};
TEST(DitherRequest, AsksForDitherWhereTheValveIsOpenAndTheBandIsWide) {
  for (const Motion motion : {Motion::rest, Motion::opening, Motion::closing, Motion::transient}) {
    Requests<double> running_valve;
    running_valve.observer.position.motion = motion;
    running_valve.run(0.002);
    EXPECT_TRUE(running_valve.request.active);
    EXPECT_LT(running_valve.request.amplitude_A, 0.01);  // it fades in
    EXPECT_NEAR(running_valve.run(dither_rise_s), 0.1, 2e-3);
  }
}

TEST(DitherRequest, AsksForNoneWhereTheBandIsAsNarrowAsWanted) {
  Requests<double> running_valve;
  running_valve.band(narrow_m3_per_s);
  EXPECT_EQ(running_valve.run(3), 0);
}

TEST(DitherRequest, AsksForNoneWhereTheSpoolCoversTheEdge) {
  Requests<double> closed;
  closed.observer.position.last_m = 0.1e-3;
  EXPECT_EQ(closed.run(3), 0);
}

TEST(DitherRequest, AsksForNoneBeforeTheFirstSampleOrWhereSamplesAreMissing) {
  Requests<double> before;
  before.observer.started = false;
  EXPECT_EQ(before.run(1), 0);
  Requests<double> missing;
  missing.observer.last.status = Status::sample_missing;
  EXPECT_EQ(missing.run(1), 0);
  Requests<double> running;
  running.observer.swing.frees = true;
  running.run(0.2);
  for (const double no_step_s : {std::nan(""), -1.0}) {
    const auto request = request_dither(running.limits, running.memory, running.valve, running.observer, no_step_s);
    EXPECT_NEAR(request.amplitude_A, 0.1, 1e-9);  // time stands still
  }
}

TEST(DitherRequest, GoesOnWhileTheSpoolSlidesAndEndsAtOnceWhereItCloses) {
  Requests<double> running_valve;
  running_valve.limits.pause_s = 0;
  running_valve.observer.swing.frees = true;
  running_valve.run(0.3);
  running_valve.observer.position.motion = Motion::opening;
  running_valve.run(0.7);
  EXPECT_NEAR(running_valve.request.amplitude_A, 0.1, 1e-9);
  running_valve.observer.position.last_m = 0.1e-3;
  EXPECT_EQ(running_valve.run(0.5), 0);
}

TEST(DitherRequest, EndsAfterItsDurationAndPausesBeforeItAsksAgain) {
  Requests<double> running_valve;
  running_valve.limits.pause_s = 0.4;
  running_valve.run(running_valve.limits.request_s + dither_fall_s + 5e-3);
  EXPECT_FALSE(running_valve.request.active);
  EXPECT_EQ(running_valve.run(running_valve.limits.pause_s - dither_fall_s - 0.02), 0);
  EXPECT_GT(running_valve.run(0.04), 0);
}

TEST(DitherRequest, GoesOnWithoutAPauseWhereTheBandStaysWide) {
  Requests<double> running_valve;
  running_valve.limits.pause_s = 0;
  running_valve.run(dither_rise_s + 2e-3);
  for (int k = 0; k < 3000; ++k) {
    running_valve.run(1e-3);
    ASSERT_GE(running_valve.request.amplitude_A, 0.099);
  }
}

TEST(DitherRequest, RaisesTheAmplitudeUntilDitherFreesTheSpoolAndNoFurtherThanItsLimit) {
  Requests<double> running_valve;
  running_valve.limits.pause_s = 0;
  EXPECT_NEAR(running_valve.run(dither_settling_s), 0.1, 1e-3);  // it takes a while until the sensor hears
  running_valve.run(0.1);
  running_valve.observer.swing.frees = true;
  const double frees_A = running_valve.memory.amplitude_A;
  EXPECT_NEAR(frees_A, 0.1 * std::exp(amplitude_raise_per_s * 0.1), 2e-3);
  running_valve.run(3);
  EXPECT_EQ(running_valve.memory.amplitude_A, frees_A);
  running_valve.observer.swing.frees = false;
  EXPECT_NEAR(running_valve.run(5), 0.3, 1e-9);
}

TEST(DitherRequest, StopsWhereTheBandBecameNarrowAndStartsNextTimeWhereItWasEnough) {
  Requests<double> running_valve;
  running_valve.run(0.3);
  running_valve.observer.swing.frees = true;
  const double enough_A = running_valve.memory.amplitude_A;
  ASSERT_GT(enough_A, 0.12);
  running_valve.band(narrow_m3_per_s);
  running_valve.run(1);
  EXPECT_FALSE(running_valve.request.active);
  EXPECT_EQ(running_valve.run(5), 0);
  running_valve.band(wide_m3_per_s);
  EXPECT_NEAR(running_valve.run(0.3), amplitude_lowering * enough_A, 1e-9);
}

TEST(DitherRequest, NeverExceedsItsLimitsWhateverTheValveDoes) {
  Requests<double> running_valve;
  running_valve.limits.pause_s = 0.05;
  unsigned dice = 1;
  for (int k = 0; k < 400; ++k) {
    dice = dice * 1664525U + 1013904223U;
    running_valve.band((dice >> 20U) % 2 == 0 ? wide_m3_per_s : narrow_m3_per_s);
    running_valve.observer.swing.frees = (dice >> 24U) % 5 == 0;
    EXPECT_LE(running_valve.run(0.01 * ((dice >> 12U) % 32)), 0.3 + 1e-12);
    EXPECT_GE(running_valve.memory.amplitude_A, 0.1);
  }
}

TEST(DitherRequest, ObeysALimitThatIsLoweredWhileItAsks) {
  Requests<double> running_valve;
  running_valve.run(0.3);
  running_valve.limits.lowest_amplitude_A = running_valve.limits.highest_amplitude_A = 0.04;
  EXPECT_NEAR(running_valve.run(0.1), 0.04, 1e-9);
  running_valve.limits.lowest_amplitude_A = running_valve.limits.highest_amplitude_A = 0;
  EXPECT_EQ(running_valve.run(1), 0);
}

TEST(DitherRequest, IsTheSameInSinglePrecision) {
  Requests<double> wide;
  Requests<float> slim;
  for (int k = 0; k < 500; ++k) {
    const double half_m3_per_s = k % 7 < 4 ? wide_m3_per_s : narrow_m3_per_s;
    wide.band(half_m3_per_s);
    slim.band(half_m3_per_s);
    wide.observer.swing.frees = slim.observer.swing.frees = k % 11 < 3;
    for (int sample = 0; sample < 37; ++sample) {
      wide.run(1e-3);
      slim.run(1e-3);
      ASSERT_NEAR(wide.request.amplitude_A, static_cast<double>(slim.request.amplitude_A), 0.005) << k;
    }
  }
}

TEST(WholeListening, HearsOnEitherSideOfTheCentreWhatOneDirectionHears) {
  Requests<float> b, a;
  const WholeValveParameters<float> valve{&b.valve, &a.valve};
  for (const bool opens_a : {false, true}) {
    WholeValveState<float> observer{};
    observer.opens_a = opens_a;
    observer.open = b.observer;
    observer.open.position.last_m = opens_a ? -b.observer.position.last_m : b.observer.position.last_m;
    DitherRequestState<float> memory{}, alone{};
    for (int k = 0; k < 400; ++k) {
      const DitherRequest<float> request = request_dither(b.limits, memory, valve, observer, 1e-3F);
      const DitherRequest<float> of_one = request_dither(b.limits, alone, b.valve, b.observer, 1e-3F);
      EXPECT_TRUE(request.active);
      EXPECT_EQ(request.amplitude_A, of_one.amplitude_A);
    }
    observer.open.position.last_m = opens_a ? -0.1e-3F : 0.1e-3F;  // back over the edge: closed on this side
    EXPECT_FALSE(request_dither(b.limits, memory, valve, observer, 1e-3F).active);
  }
}

TEST(WholeListening, IsClosedByTheEdgeOfTheSideOnWhichTheSpoolStands) {
  Requests<float> b, a;
  a.valve.closed_below_m = 1.5e-3F;
  const WholeValveParameters<float> valve{&b.valve, &a.valve};
  for (const bool opens_a : {false, true}) {
    WholeValveState<float> observer{};
    observer.open = b.observer;
    observer.opens_a = opens_a;
    observer.open.position.last_m = opens_a ? -1e-3F : 1e-3F;
    DitherRequestState<float> memory{};
    request_dither(b.limits, memory, valve, observer, 1e-3F);
    EXPECT_EQ(request_dither(b.limits, memory, valve, observer, 1e-3F).active, !opens_a);
  }
}

}  // namespace
}  // namespace spoolflow::sensor
