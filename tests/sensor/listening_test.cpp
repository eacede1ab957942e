/// Listening asks for dither where the observer cannot hear, within the limits that it was given.
#include "spoolflow/sensor/listening.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "spoolflow/sensor/whole_valve/whole_listening.hpp"

namespace spoolflow::sensor {
namespace {

template <class T>
constexpr ListeningParameters<T> listening_limits{T(1e-5), T(0.1), T(0.3), T(125), T(0.5), T(0.2)};
constexpr double rests_open_m = 1e-3;
constexpr double wide_m3_per_s = 3e-5;    ///< half width
constexpr double narrow_m3_per_s = 5e-6;  ///< half width

/// An observer whose state says what a test wants, sampled at 1 kHz.
template <class T>
struct Listener {
  ListeningParameters<T> limits = listening_limits<T>;
  ListeningState<T> memory{};
  ObserverParameters<T> valve{};
  ObserverState<T> observer{};
  DitherRequest<T> request{};

  Listener() {
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
  double hear(double duration_s) {
    double largest_A = 0;
    for (int k = 0; k < std::lround(duration_s / 1e-3); ++k) {
      request = listen(limits, memory, valve, observer, T(1e-3));
      EXPECT_EQ(request.active, request.amplitude_A > T(0));
      EXPECT_EQ(request.frequency_Hz, request.active ? limits.frequency_Hz : T(0));
      largest_A = std::max(largest_A, static_cast<double>(request.amplitude_A));
    }
    return largest_A;
  }
};
TEST(Listening, AsksForDitherWhereTheValveIsOpenAndTheBandIsWide) {
  for (const Motion motion : {Motion::rest, Motion::opening, Motion::closing, Motion::transient}) {
    Listener<double> listener;
    listener.observer.position.motion = motion;
    listener.hear(0.002);
    EXPECT_TRUE(listener.request.active);
    EXPECT_LT(listener.request.amplitude_A, 0.01);  // it fades in
    EXPECT_NEAR(listener.hear(dither_rise_s), 0.1, 2e-3);
  }
}

TEST(Listening, AsksForNoneWhereTheBandIsAsNarrowAsWanted) {
  Listener<double> listener;
  listener.band(narrow_m3_per_s);
  EXPECT_EQ(listener.hear(3), 0);
}

TEST(Listening, AsksForNoneWhereTheSpoolCoversTheEdge) {
  Listener<double> closed;
  closed.observer.position.last_m = 0.1e-3;
  EXPECT_EQ(closed.hear(3), 0);
}

TEST(Listening, AsksForNoneBeforeTheFirstSampleOrWhereSamplesAreMissing) {
  Listener<double> before;
  before.observer.started = false;
  EXPECT_EQ(before.hear(1), 0);
  Listener<double> missing;
  missing.observer.last.status = Status::sample_missing;
  EXPECT_EQ(missing.hear(1), 0);
  Listener<double> running;
  running.observer.swing.frees = true;
  running.hear(0.2);
  for (const double no_step_s : {std::nan(""), -1.0}) {
    const auto request = listen(running.limits, running.memory, running.valve, running.observer, no_step_s);
    EXPECT_NEAR(request.amplitude_A, 0.1, 1e-9);  // time stands still
  }
}

TEST(Listening, GoesOnWhileTheSpoolSlidesAndEndsAtOnceWhereItCloses) {
  Listener<double> listener;
  listener.limits.pause_s = 0;
  listener.observer.swing.frees = true;
  listener.hear(0.3);
  listener.observer.position.motion = Motion::opening;
  listener.hear(0.7);
  EXPECT_NEAR(listener.request.amplitude_A, 0.1, 1e-9);
  listener.observer.position.last_m = 0.1e-3;
  EXPECT_EQ(listener.hear(0.5), 0);
}

TEST(Listening, EndsAfterItsDurationAndPausesBeforeItAsksAgain) {
  Listener<double> listener;
  listener.limits.pause_s = 0.4;
  listener.hear(listener.limits.request_s + dither_fall_s + 5e-3);
  EXPECT_FALSE(listener.request.active);
  EXPECT_EQ(listener.hear(listener.limits.pause_s - dither_fall_s - 0.02), 0);
  EXPECT_GT(listener.hear(0.04), 0);
}

TEST(Listening, GoesOnWithoutAPauseWhereTheBandStaysWide) {
  Listener<double> listener;
  listener.limits.pause_s = 0;
  listener.hear(dither_rise_s + 2e-3);
  for (int k = 0; k < 3000; ++k) {
    listener.hear(1e-3);
    ASSERT_GE(listener.request.amplitude_A, 0.099);
  }
}

TEST(Listening, RaisesTheAmplitudeUntilDitherFreesTheSpoolAndNoFurtherThanItsLimit) {
  Listener<double> listener;
  listener.limits.pause_s = 0;
  EXPECT_NEAR(listener.hear(hearing_s), 0.1, 1e-3);  // it takes a while until the sensor hears
  listener.hear(0.1);
  listener.observer.swing.frees = true;
  const double frees_A = listener.memory.amplitude_A;
  EXPECT_NEAR(frees_A, 0.1 * std::exp(amplitude_raise_per_s * 0.1), 2e-3);
  listener.hear(3);
  EXPECT_EQ(listener.memory.amplitude_A, frees_A);
  listener.observer.swing.frees = false;
  EXPECT_NEAR(listener.hear(5), 0.3, 1e-9);
}

TEST(Listening, StopsWhereTheBandBecameNarrowAndStartsNextTimeWhereItWasEnough) {
  Listener<double> listener;
  listener.hear(0.3);
  listener.observer.swing.frees = true;
  const double enough_A = listener.memory.amplitude_A;
  ASSERT_GT(enough_A, 0.12);
  listener.band(narrow_m3_per_s);
  listener.hear(1);
  EXPECT_FALSE(listener.request.active);
  EXPECT_EQ(listener.hear(5), 0);
  listener.band(wide_m3_per_s);
  EXPECT_NEAR(listener.hear(0.3), amplitude_lowering * enough_A, 1e-9);
}

TEST(Listening, NeverExceedsItsLimitsWhateverTheValveDoes) {
  Listener<double> listener;
  listener.limits.pause_s = 0.05;
  unsigned dice = 1;
  for (int k = 0; k < 400; ++k) {
    dice = dice * 1664525U + 1013904223U;
    listener.band((dice >> 20U) % 2 == 0 ? wide_m3_per_s : narrow_m3_per_s);
    listener.observer.swing.frees = (dice >> 24U) % 5 == 0;
    EXPECT_LE(listener.hear(0.01 * ((dice >> 12U) % 32)), 0.3 + 1e-12);
    EXPECT_GE(listener.memory.amplitude_A, 0.1);
  }
}

TEST(Listening, ObeysALimitThatIsLoweredWhileItAsks) {
  Listener<double> listener;
  listener.hear(0.3);
  listener.limits.lowest_amplitude_A = listener.limits.highest_amplitude_A = 0.04;
  EXPECT_NEAR(listener.hear(0.1), 0.04, 1e-9);
  listener.limits.lowest_amplitude_A = listener.limits.highest_amplitude_A = 0;
  EXPECT_EQ(listener.hear(1), 0);
}

TEST(Listening, IsTheSameInSinglePrecision) {
  Listener<double> wide;
  Listener<float> slim;
  for (int k = 0; k < 500; ++k) {
    const double half_m3_per_s = k % 7 < 4 ? wide_m3_per_s : narrow_m3_per_s;
    wide.band(half_m3_per_s);
    slim.band(half_m3_per_s);
    wide.observer.swing.frees = slim.observer.swing.frees = k % 11 < 3;
    for (int sample = 0; sample < 37; ++sample) {
      wide.hear(1e-3);
      slim.hear(1e-3);
      ASSERT_NEAR(wide.request.amplitude_A, static_cast<double>(slim.request.amplitude_A), 0.005) << k;
    }
  }
}

TEST(WholeListening, HearsOnEitherSideOfTheCentreWhatOneDirectionHears) {
  Listener<float> b, a;
  const WholeValveParameters<float> valve{&b.valve, &a.valve};
  for (const bool opens_a : {false, true}) {
    WholeValveState<float> observer{};
    observer.opens_a = opens_a;
    observer.open = b.observer;
    observer.open.position.last_m = opens_a ? -b.observer.position.last_m : b.observer.position.last_m;
    ListeningState<float> memory{}, alone{};
    for (int k = 0; k < 400; ++k) {
      const DitherRequest<float> request = listen(b.limits, memory, valve, observer, 1e-3F);
      const DitherRequest<float> of_one = listen(b.limits, alone, b.valve, b.observer, 1e-3F);
      EXPECT_TRUE(request.active);
      EXPECT_EQ(request.amplitude_A, of_one.amplitude_A);
    }
    observer.open.position.last_m = opens_a ? -0.1e-3F : 0.1e-3F;  // back over the edge: closed on this side
    EXPECT_FALSE(listen(b.limits, memory, valve, observer, 1e-3F).active);
  }
}

TEST(WholeListening, IsClosedByTheEdgeOfTheSideOnWhichTheSpoolStands) {
  Listener<float> b, a;
  a.valve.closed_below_m = 1.5e-3F;
  const WholeValveParameters<float> valve{&b.valve, &a.valve};
  for (const bool opens_a : {false, true}) {
    WholeValveState<float> observer{};
    observer.open = b.observer;
    observer.opens_a = opens_a;
    observer.open.position.last_m = opens_a ? -1e-3F : 1e-3F;
    ListeningState<float> memory{};
    listen(b.limits, memory, valve, observer, 1e-3F);
    EXPECT_EQ(listen(b.limits, memory, valve, observer, 1e-3F).active, !opens_a);
  }
}

}  // namespace
}  // namespace spoolflow::sensor
