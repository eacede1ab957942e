/// What the spool does, found from a signal with noise, drift and faults, at every sampling rate.
#include "spoolflow/sensor/signals/position_track.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>

#include <gtest/gtest.h>

namespace spoolflow::sensor {
namespace {

constexpr PositionSensor<double> signal_of_lvdt{.noise_m = 0.4e-6,
                                                .backlash_m = 0.5e-6,
                                                .drift_m_per_K = 2e-7,
                                                .drift_free_K = 313,
                                                .hardest_acceleration_m_per_s2 = 90};

class PositionTrack : public testing::TestWithParam<double> {
 protected:
  using Course = std::function<double(double time_s)>;
  struct Seen : PositionPoint<double> {
    bool fault;
    double elsewhere_m;
  };
  using Each = std::function<void(double time_s, const Seen& point)>;

  /// The track over the signal of a course; `fault_m` adds to the signal. The coil's current shows no motion where
  /// it is steady, and the voltage with it where there is one.
  void follow(double duration_s, const Course& course, const Each& each, const Course& fault_m = nullptr,
              const Course& voltage_V = nullptr, const Course& current_A = nullptr, double elastic_m = 0) const {
    std::mt19937 generator(3);
    std::normal_distribution<double> noise_m(0, signal_of_lvdt.noise_m);
    PositionState<double> state{};
    begin(state, course(0));
    for (int k = 0; k * step_s() < duration_s; ++k) {
      const double time_s = k * step_s();
      Sample<double> sample{};
      sample.time_step_s = step_s();
      sample.position_m = course(time_s) + noise_m(generator) + (fault_m ? fault_m(time_s) : 0);
      sample.voltage_V = voltage_V ? voltage_V(time_s) : std::nan("");
      sample.current_A = current_A ? current_A(time_s) : 0;
      const PositionPoint<double> point = track(signal_of_lvdt, state, sample, {.current_A = 0.01, .voltage_V = 0.2},
                                                0.0, {}, false, [&] { return elastic_m; });
      each(time_s, {point, is_doubted(state), sensor::elsewhere_m(state, point)});
    }
  }
  [[nodiscard]] static double step_s() { return GetParam(); }
};
INSTANTIATE_TEST_SUITE_P(SampledEvery, PositionTrack, testing::Values(50e-6, 200e-6, 1e-3, 5e-3),
                         [](const auto& rate) { return std::to_string(static_cast<int>(1e6 * rate.param)) + "us"; });

TEST_P(PositionTrack, SeparatesRestFromNoise) {
  int moving = 0, samples = 0;
  follow(
      5, [](double) { return 1e-3; },
      [&](double, const Seen& point) {
        moving += point.motion == Motion::rest ? 0 : 1;
        ++samples;
      });
  EXPECT_LT(moving, 0.01 * samples);
}

TEST_P(PositionTrack, LearnsThatItsSignalHasMoreNoiseThanTheBenchHad) {
  std::mt19937 generator(5);
  std::normal_distribution<double> more_noise_m(0, 2 * signal_of_lvdt.noise_m);
  const double learnt_s = 1000 * step_s() + 0.5;
  int moving = 0, samples = 0;
  follow(
      learnt_s + 5, [](double) { return 1e-3; },
      [&](double time_s, const Seen& point) {
        if (time_s < learnt_s) return;
        moving += point.motion == Motion::rest ? 0 : 1;
        ++samples;
      },
      [&](double) { return more_noise_m(generator); });
  EXPECT_LT(moving, 0.02 * samples);
}

TEST_P(PositionTrack, FindsWhichWayTheSpoolSlidesWithinAFewBlocks) {
  // 0.12 mm/s is 5 %/s, the paper's stroke; 10 mm/s is a fast duty cycle.
  for (const double speed_m_per_s : {0.12e-3, 1e-3, 10e-3}) {
    const double turn_s = 1.5e-3 / speed_m_per_s;
    const auto course = [&](double time_s) { return speed_m_per_s * (time_s < turn_s ? time_s : 2 * turn_s - time_s); };
    const double blocks = speed_m_per_s < 0.5e-3 ? 32 : 9;  // the long windows, or the short
    const double found_after_s = blocks * std::max(step_s(), block_length_s);
    int wrong = 0, opening = 0, closing = 0, samples = 0;
    follow(2 * turn_s, course, [&](double time_s, const Seen& point) {
      const double since_s = time_s < turn_s ? time_s : time_s - turn_s;
      if (since_s < found_after_s) return;
      ++samples;
      opening += point.motion == Motion::opening ? 1 : 0;
      closing += point.motion == Motion::closing ? 1 : 0;
      wrong += point.motion == (time_s < turn_s ? Motion::closing : Motion::opening) ? 1 : 0;
    });
    EXPECT_EQ(wrong, 0) << speed_m_per_s;
    EXPECT_GT(opening + closing, 0.95 * samples) << speed_m_per_s;
  }
}

TEST_P(PositionTrack, TakesNoCreepThatContactsGiveElasticallyForSlidingHoweverFinelyItIsSampled) {
  const double window_s = long_window_blocks * std::max(step_s(), block_length_s), elastic_m = 1.5e-6;
  const auto share_sliding = [&](double speed_m_per_s, double contacts_give_m) {
    int sliding = 0, samples = 0;
    follow(
        100 * window_s, [&](double time_s) { return speed_m_per_s * time_s; },
        [&](double time_s, const Seen& point) {
          if (time_s < 5 * window_s) return;
          sliding += slides(point.motion) ? 1 : 0;
          ++samples;
        },
        nullptr, nullptr, nullptr, contacts_give_m);
    return static_cast<double>(sliding) / samples;
  };
  EXPECT_LT(share_sliding(0.7 * elastic_m / window_s, elastic_m), 0.05);
  EXPECT_GT(share_sliding(0.7 * elastic_m / window_s, 0), step_s() < 1e-3 ? 0.9 : 0.2);  // noise hides it there
  EXPECT_GT(share_sliding(2 * elastic_m / window_s, elastic_m), 0.95);
}

TEST_P(PositionTrack, FindsASlipWithItsDirectionAndLetsItSettle) {
  int transients = 0;
  double direction = 0;
  follow(
      1.0, [](double time_s) { return 1e-3 - (time_s < 0.5 ? 0 : std::min((time_s - 0.5) / 5e-3, 1.0) * 50e-6); },
      [&](double time_s, const Seen& point) {
        if (point.motion == Motion::transient) {
          ++transients;
          direction = point.travel_m;
        }
        if (time_s < 0.5 || time_s > 0.58) {
          EXPECT_EQ(point.motion, Motion::rest) << time_s;
        }
      });
  EXPECT_GT(transients * step_s(), 0.015);
  EXPECT_LT(direction, 0);
}

TEST_P(PositionTrack, TakesAFaultOutOfTheSignalUntilItIsOver) {
  if (step_s() > 2e-3) GTEST_SKIP() << "90 m/s2 allow 2.3 mm in 5 ms: no jump is beyond it";
  follow(
      1, [](double time_s) { return 0.5e-3 + 1e-3 * time_s; },
      [&](double time_s, const Seen& point) {
        EXPECT_NEAR(point.position_m, 0.5e-3 + 1e-3 * time_s, 25e-6) << time_s;
        EXPECT_EQ(point.fault, time_s >= 0.4 && time_s < 0.45) << time_s;
      },
      [](double time_s) { return time_s >= 0.4 && time_s < 0.45 - 1e-9 ? 0.24e-3 + step_s() : 0; });
}

TEST_P(PositionTrack, TakesAFaultOutThatTheCoilKnowsNothingOfHoweverLongTheStep) {
  const double until_s = 0.45;
  follow(
      1, [](double time_s) { return 0.5e-3 + 0.1e-3 * time_s; },
      [&](double time_s, const Seen& point) {
        EXPECT_NEAR(point.position_m, 0.5e-3 + 0.1e-3 * time_s, 5e-6) << time_s;
        EXPECT_EQ(point.fault, time_s >= 0.4 && time_s < until_s) << time_s;
      },
      [&](double time_s) { return time_s >= 0.4 && time_s < until_s - 1e-9 ? 0.15e-3 : 0; }, [](double) { return 5; });
}

TEST_P(PositionTrack, AcceptsASlipThatTheVoltageShows) {
  if (step_s() < 2e-3) GTEST_SKIP() << "no spool slips by 0.15 mm within one sample";
  follow(
      1, [](double time_s) { return time_s < 0.4 ? 1e-3 : 1.15e-3; },
      [&](double time_s, const Seen& point) { EXPECT_FALSE(point.fault) << time_s; }, nullptr,
      [](double time_s) { return time_s < 0.4 ? 5 : 5.5; });
}

TEST_P(PositionTrack, AcceptsASpoolThatRingsWithItsCurrentAndNoneThatRingsByItself) {
  if (step_s() > 2e-3 || step_s() < 1e-3) GTEST_SKIP() << "within noise, or allowed by 90 m/s2";
  const double per_s = 2 * M_PI * 200;
  const auto rings_m = [&](double time_s) {
    return 1e-3 + (time_s < 0.4 ? 0 : 0.2e-3 * std::sin(per_s * time_s));
  };  // 316 m/s2
  const auto none = [](double /*time_s*/, const Seen& point) { EXPECT_FALSE(point.fault); };
  follow(0.5, rings_m, none, nullptr, nullptr,
         [&](double time_s) { return time_s < 0.4 ? 1 : 1 - 0.3 * std::sin(per_s * time_s); });
  bool doubted = false;
  follow(0.5, rings_m, [&](double /*time_s*/, const Seen& point) { doubted |= point.fault; });
  EXPECT_TRUE(doubted);
}

TEST_P(PositionTrack, BelievesASpoolThatStopsInNoTime) {
  const auto speeds_up_m = [](double for_s) { return 0.5 * 80 * for_s * for_s; };  // to 0.4 m/s
  follow(
      1, [&](double time_s) { return 0.2e-3 + speeds_up_m(std::clamp(time_s - 0.4, 0.0, 5e-3)); },
      [&](double time_s, const Seen& point) { EXPECT_FALSE(point.fault) << time_s; }, nullptr,
      [](double time_s) { return 5 + 1000 * time_s; });
}

TEST_P(PositionTrack, BelievesAJumpThatLastsAndDoubtsItForAWhile) {
  if (step_s() > 2e-3) GTEST_SKIP() << "90 m/s2 allow 2.3 mm in 5 ms: no jump is beyond it";
  follow(
      4, [](double) { return 1e-3; },
      [&](double time_s, const Seen& point) {
        if (time_s < 0.4 || time_s > 0.4 + longest_position_doubt_s + 3 * step_s()) {
          EXPECT_FALSE(point.fault) << time_s;
        }
        if (point.fault) {
          EXPECT_NEAR(point.elsewhere_m, time_s < 0.4 + longest_position_fault_s ? 1.4e-3 : 1e-3, 6e-6) << time_s;
        }
        if (time_s > 0.7) {
          EXPECT_NEAR(point.position_m, 1.4e-3, 6e-6);
        }
      },
      [](double time_s) { return time_s >= 0.4 ? 0.4e-3 : 0; });
}

TEST_P(PositionTrack, BelievesTheWayBackFromAJumpThatItBelieved) {
  if (step_s() > 2e-3) GTEST_SKIP() << "90 m/s2 allow 2.3 mm in 5 ms: no jump is beyond it";
  follow(
      2, [](double) { return 1e-3; },
      [&](double time_s, const Seen& point) {
        if (time_s > 1.2 + step_s()) {
          EXPECT_NEAR(point.position_m, 1e-3, 6e-6) << time_s;
          EXPECT_FALSE(point.fault) << time_s;
        }
      },
      [](double time_s) { return time_s >= 0.4 && time_s < 1.2 ? 0.4e-3 : 0; });
}

TEST(PositionTrack, TakesTheDriftOfItsZeroOff) {
  EXPECT_NEAR(drift_free_m(signal_of_lvdt, 1e-3 + 30 * 2e-7, 343.0), 1e-3, 1e-12);
  EXPECT_NEAR(drift_free_m(signal_of_lvdt, 1e-3, 313.0), 1e-3, 1e-12);
}

}  // namespace
}  // namespace spoolflow::sensor
