#include "spoolflow/validation/phases.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace spoolflow::validation {
namespace {

constexpr double step_s = 0.01;
constexpr double whole_stroke_m = 2e-3;

/// A triangle: 5 % of the stroke a second up to fully open, 4 s of hold, down again, straight up to a tenth.
struct Triangle {
  std::vector<double> time_s, share;

  Triangle() {
    run(0.05, 20);
    run(0, 4);
    run(-0.05, 20);
    run(0.05, 2);
  }
  void run(double rate_per_s, double duration_s) {
    const double from = share.empty() ? 0 : share.back();
    const int samples = static_cast<int>(std::lround(duration_s / step_s));
    for (int k = 1; k <= samples; ++k) {
      time_s.push_back(static_cast<double>(time_s.size()) * step_s);
      share.push_back(from + rate_per_s * k * step_s);
    }
  }
  [[nodiscard]] std::size_t at(double when_s) const { return static_cast<std::size_t>(std::lround(when_s / step_s)); }
};

TEST(Phases, OfAPositionAreMotionHoldAndTheSecondsAroundEachTurn) {
  const Triangle triangle;
  const Phases phases = phases_of_position(triangle.time_s, triangle.share, 1);
  EXPECT_TRUE(phases.moving[triangle.at(10)]);
  EXPECT_FALSE(phases.rest[triangle.at(10)]);
  EXPECT_TRUE(phases.rest[triangle.at(22)]);
  for (const double turn_s : {20.0, 24.0, 44.0}) {
    EXPECT_TRUE(phases.reversal[triangle.at(turn_s - 1.9)]) << turn_s;
    EXPECT_TRUE(phases.reversal[triangle.at(std::min(turn_s + 1.9, 45.9))]) << turn_s;
  }
  EXPECT_FALSE(phases.reversal[triangle.at(17.5)]);
  EXPECT_FALSE(phases.reversal[triangle.at(30)]);
}

TEST(Phases, OfAWholeValveOpenAwayFromTheCentreOnEitherSide) {
  Triangle triangle;
  for (double& share : triangle.share) share = -share;
  const Phases phases = phases_of_position(triangle.time_s, triangle.share, 1);
  EXPECT_TRUE(phases.opening[triangle.at(10)]) << "towards P to A";
  EXPECT_FALSE(phases.opening[triangle.at(30)]);
  EXPECT_TRUE(phases.rest[triangle.at(22)]) << "fully open to the other side";
  EXPECT_TRUE(phases.reversal[triangle.at(21)]) << "a stop far from the centre";
  std::vector<double> time_s, through;
  for (int k = 0; k < 4000; ++k) time_s.push_back(step_s * k), through.push_back(-1 + 5e-4 * k);
  const Phases passage = phases_of_position(time_s, through, 1);
  EXPECT_FALSE(passage.opening[1000]);
  EXPECT_TRUE(passage.opening[3000]);
  EXPECT_FALSE(passage.reversal[2000]) << "the spool goes through the centre without turning";
}

TEST(Phases, OfANoisyPositionAreThoseOfTheSpoolButForTheEdges) {
  const Triangle triangle;
  std::mt19937 generator(3);
  std::normal_distribution<double> noise_m(0, 1e-6);
  std::vector<double> position_m;
  for (const double share : triangle.share) position_m.push_back(share * whole_stroke_m + noise_m(generator));
  const Phases true_ones = phases_of_position(triangle.time_s, triangle.share, 1);
  const Phases measured = phases_of_position(triangle.time_s, position_m, whole_stroke_m);
  int different = 0;
  for (std::size_t k = 0; k < position_m.size(); ++k) {
    different += measured.moving[k] != true_ones.moving[k] || measured.reversal[k] != true_ones.reversal[k] ? 1 : 0;
  }
  // The rate is taken over half a second: at each of the turns and ends up to that long may differ.
  EXPECT_LT(different * step_s, 2.0);
}

TEST(Phases, OfASpoolThatOnlyShakesByNoiseAreRest) {
  std::mt19937 generator(3);
  std::normal_distribution<double> noise_m(0, 1e-6);
  std::vector<double> time_s;
  std::vector<double> position_m;
  for (int k = 0; k < 2000; ++k) {
    time_s.push_back(k * 1e-3);
    position_m.push_back(1e-3 + noise_m(generator));
  }
  const Phases phases = phases_of_position(time_s, position_m, whole_stroke_m);
  for (std::size_t k = 0; k < time_s.size(); ++k) {
    EXPECT_TRUE(phases.rest[k]) << k;
    EXPECT_FALSE(phases.reversal[k]) << k;
  }
}

TEST(Phases, OfASpoolThatStepsMoveWhileItMovesAndNotASampleMore) {
  constexpr double begins_s = 1, ends_s = 1.02, travel_m = 1e-3;  // 50 mm/s
  std::mt19937 generator(3);
  std::normal_distribution<double> noise_m(0, 1e-6);
  std::vector<double> time_s, position_m;
  for (int k = 0; k < 2000; ++k) {
    time_s.push_back(k * 1e-3);
    const double gone = std::clamp((time_s.back() - begins_s) / (ends_s - begins_s), 0.0, 1.0);
    position_m.push_back(0.5e-3 + travel_m * gone + noise_m(generator));
  }
  const Phases phases = phases_of_position(time_s, position_m, whole_stroke_m);
  for (std::size_t k = 0; k < time_s.size(); ++k) {
    const bool inside = time_s[k] > begins_s && time_s[k] < ends_s;
    const bool beside = time_s[k] < begins_s - 0.021 || time_s[k] > ends_s + 0.021;  // half a window
    if (inside || beside) {
      EXPECT_EQ(phases.moving[k], inside) << time_s[k];
    }
  }
  EXPECT_NEAR(phases.velocity_m_per_s[1010], 0.05, 0.02) << "a mean over 40 ms";
  EXPECT_EQ(phases.velocity_m_per_s[500], 0);
}

TEST(Phases, OfADitheredSpoolAreThoseOfItsMean) {
  std::vector<double> time_s, position_m;
  for (int k = 0; k < 4000; ++k) {
    time_s.push_back(k * 1e-3);
    const double mean_m = time_s.back() < 2 ? 1e-3 : 1e-3 + 0.1e-3 * (time_s.back() - 2);  // 5 % of the stroke a second
    position_m.push_back(mean_m + 5e-6 * std::sin(2 * std::numbers::pi * 100 * time_s.back()));
  }
  const Phases phases = phases_of_position(time_s, position_m, whole_stroke_m);
  for (std::size_t k = 20; k < 1700; ++k) EXPECT_TRUE(phases.rest[k]) << k;  // a period and more on either side
  for (std::size_t k = 2300; k < 3700; ++k) EXPECT_TRUE(phases.moving[k]) << k;
}

TEST(Phases, SurviveMissingPositionsGapsAndASingleSample) {
  const double missing_m = std::nan("");
  const Phases single = phases_of_position(std::vector{0.0}, std::vector{missing_m}, whole_stroke_m);
  EXPECT_FALSE(single.moving[0]);
  const Phases holes = phases_of_position(std::vector{0.0, 0.001, 5.0, 5.001},
                                          std::vector{1e-3, missing_m, missing_m, 1e-3}, whole_stroke_m);
  EXPECT_EQ(holes.moving, std::vector<bool>(4, false));
  EXPECT_EQ(phases_of_position(std::vector{0.0}, std::vector{0.5}, 1).rest, std::vector<bool>{true});
  EXPECT_TRUE(phases_of_position({}, {}, 1).moving.empty());
}

}  // namespace
}  // namespace spoolflow::validation
