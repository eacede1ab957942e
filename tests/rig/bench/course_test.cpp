#include "spoolflow/rig/bench/course.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace spoolflow::rig {
namespace {

TEST(Course, HoldsItsStartWhereNothingIsPlanned) {
  const Course course(3.5);
  EXPECT_EQ(course.at(-1), 3.5);
  EXPECT_EQ(course.at(100), 3.5);
  EXPECT_EQ(course.duration_s(), 0);
}

TEST(Course, RampsAtTheAskedRateAndHoldsTheEnd) {
  Course course(1);
  course.hold(2).ramp_at(3, 0.5).hold(1).ramp_at(0, 1);
  EXPECT_DOUBLE_EQ(course.duration_s(), 2 + 4 + 1 + 3);
  EXPECT_DOUBLE_EQ(course.at(1.9), 1);
  EXPECT_DOUBLE_EQ(course.at(4), 2);
  EXPECT_DOUBLE_EQ(course.at(6.5), 3);
  EXPECT_DOUBLE_EQ(course.at(9), 1);
  EXPECT_DOUBLE_EQ(course.at(50), 0);
}

TEST(Course, StepsWithoutTakingTime) {
  Course course(0);
  course.hold(1).step_to(5).hold(1);
  EXPECT_EQ(course.at(0.999999), 0);
  EXPECT_EQ(course.at(1), 5);
  EXPECT_EQ(course.duration_s(), 2);
}

TEST(Course, SwingsAboutTheValueItHadReached) {
  Course course(2);
  course.sine({.amplitude = 0.5, .amplitude_end = 0.5, .frequency_Hz = 4, .frequency_end_Hz = 4, .duration_s = 1});
  EXPECT_NEAR(course.at(1.0 / 16), 2.5, 1e-12);
  EXPECT_NEAR(course.at(3.0 / 16), 1.5, 1e-12);
  EXPECT_DOUBLE_EQ(course.at(1), 2);
}

TEST(Course, SweepsWithEqualTimeAnOctave) {
  const double start_Hz = 1, end_Hz = 16, duration_s = 8;
  Course course(0);
  course.sine({.amplitude = 1,
               .amplitude_end = 1,
               .frequency_Hz = start_Hz,
               .frequency_end_Hz = end_Hz,
               .duration_s = duration_s});
  // Upward zero crossings before a time: the integral of the frequency up to it, counted from one at the start.
  const auto crossings = [&](double until_s) {
    int count = 0;
    for (double t = 1e-4; t < until_s; t += 1e-4) {
      count += course.at(t) >= 0 && course.at(t - 1e-4) < 0;
    }
    return count;
  };
  const auto cycles = [&](double t) { return start_Hz * 2 / std::numbers::ln2 * (std::exp2(t / 2) - 1); };
  EXPECT_EQ(crossings(4.0), static_cast<int>(cycles(4.0)));
  EXPECT_EQ(crossings(7.9), static_cast<int>(cycles(7.9)));
}

}  // namespace
}  // namespace spoolflow::rig
