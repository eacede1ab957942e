#include "spoolflow/rig/instruments/instruments.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace spoolflow::rig {
namespace {

Lvdt without_errors() {
  return {.zero_offset_m = 0,
          .zero_drift_per_K = 0,
          .linearity = 0,
          .backlash_m = 0,
          .time_constant_s = 0,
          .noise_m = 0,
          .resolution_m = 0};
}

TEST(Lvdt, ShowsThePositionWhenItHasNoErrors) {
  LvdtReading reading(without_errors(), 1, 0, 30);
  reading.follow(1.234e-3, 80, 1e-4);
  EXPECT_DOUBLE_EQ(reading.acquired_m(0), 1.234e-3);
  EXPECT_DOUBLE_EQ(reading.valve_signal_m(), 1.234e-3);
}

TEST(Lvdt, DriftsWithTheOilByItsDataSheet) {
  Lvdt lvdt = without_errors();
  lvdt.zero_drift_per_K = 1.5e-4;
  lvdt.reference_temperature_C = 30;
  LvdtReading reading(lvdt, 1, 0, 30);
  reading.follow(0, 70, 1e-4);
  EXPECT_NEAR(reading.acquired_m(0), 1.5e-4 * 2.4e-3 * 40, 1e-15);
}

TEST(Lvdt, LosesItsBacklashAtEachReversal) {
  Lvdt lvdt = without_errors();
  lvdt.backlash_m = 1e-6;
  LvdtReading reading(lvdt, 1, 0, 30);
  reading.follow(1e-3, 30, 1e-4);
  const double up_m = reading.acquired_m(0);
  reading.follow(1e-3 - 1.5e-6, 30, 1e-4);
  EXPECT_DOUBLE_EQ(reading.acquired_m(0), up_m);
  reading.follow(0.5e-3, 30, 1e-4);
  EXPECT_NEAR(reading.acquired_m(0) - 0.5e-3, 1e-6, 1e-12);
  EXPECT_NEAR(up_m - 1e-3, -1e-6, 1e-12);
}

TEST(Lvdt, BowsByItsLinearityAndIsTrueAtBothEnds) {
  Lvdt lvdt = without_errors();
  lvdt.linearity = 2e-3;
  LvdtReading reading(lvdt, 1, 0, 30);
  double largest_m = 0;
  for (double share = 0; share <= 1; share += 0.01) {
    reading.follow(share * lvdt.range_m, 30, 1e-4);
    largest_m = std::max(largest_m, std::abs(reading.acquired_m(0) - share * lvdt.range_m));
  }
  EXPECT_NEAR(largest_m, 2e-3 * lvdt.range_m, 0.01 * 2e-3 * lvdt.range_m);
  reading.follow(lvdt.range_m, 30, 1e-4);
  EXPECT_NEAR(reading.acquired_m(0), lvdt.range_m, 1e-12);
}

TEST(Lvdt, IsQuantisedAndNoisyAsStated) {
  Lvdt lvdt = without_errors();
  lvdt.noise_m = 0.7e-6;
  lvdt.resolution_m = 0.08e-6;
  LvdtReading reading(lvdt, 1, 1e-3, 30);
  double square = 0;
  for (int k = 0; k < 20000; ++k) {
    const double error_m = reading.acquired_m(k * 1e-3) - 1e-3;
    const double steps = error_m / lvdt.resolution_m;
    ASSERT_NEAR(steps, std::round(steps), 1e-6);
    square += error_m * error_m;
  }
  EXPECT_NEAR(std::sqrt(square / 20000), 0.7e-6, 0.02e-6);
}

TEST(Lvdt, FaultsJumpTheRecordingForMillisecondsAndNeverTheValvesOwnSignal) {
  Lvdt lvdt = without_errors();
  lvdt.fault_rate_per_s = 0.5;
  LvdtReading reading(lvdt, 1, 1e-3, 30);
  int faults = 0, faulty = 0;
  bool before = false;
  const int count = 400000;
  for (int k = 0; k < count; ++k) {
    const double error_m = reading.acquired_m(k * 1e-3) - 1e-3;
    const bool jumped = error_m != 0;
    if (jumped) {
      ASSERT_GE(std::abs(error_m), 0.5 * lvdt.fault_jump * lvdt.range_m * (1 - 1e-9));
      ASSERT_LE(std::abs(error_m), lvdt.fault_jump * lvdt.range_m * (1 + 1e-9));
    }
    faults += jumped && !before;
    faulty += jumped;
    before = jumped;
    ASSERT_EQ(reading.valve_signal_m(), 1e-3);
  }
  EXPECT_NEAR(faults, 200, 5 * std::sqrt(200.0));
  EXPECT_NEAR(static_cast<double>(faulty) / faults, 1e3 * lvdt.fault_duration_s, 3);
}

TEST(Lvdt, FollowsAStepWithItsDemodulatorsTimeConstant) {
  Lvdt lvdt = without_errors();
  lvdt.time_constant_s = 1e-3;
  LvdtReading reading(lvdt, 1, 0, 30);
  for (int k = 0; k < 10; ++k) {
    reading.follow(1e-3, 30, 1e-4);
  }
  EXPECT_NEAR(reading.acquired_m(0), 1e-3 * (1 - std::exp(-1)), 1e-9);
}

TEST(FlowMeter, LagsByThirtyMilliseconds) {
  FlowMeter meter;
  meter.gain_error = meter.pulsation = meter.noise_m3_per_s = meter.resolution_m3_per_s = 0;
  FlowMeterReading reading(meter, 1, 0);
  for (int k = 0; k < 30; ++k) {
    reading.follow(1e-3, 1e-3);
  }
  EXPECT_NEAR(reading.reading_m3_per_s(), 1e-3 * (1 - std::exp(-1)), 1e-12);
}

TEST(FlowMeter, PulsesWithEveryToothAndKeepsTheMean) {
  FlowMeter meter;
  meter.gain_error = meter.noise_m3_per_s = meter.resolution_m3_per_s = 0;
  meter.time_constant_s = 0;
  meter.pulsation = 0.02;
  FlowMeterReading reading(meter, 1, 0);
  const double flow_m3_per_s = 1e-4;  // 100 teeth a second
  double sum = 0, lowest = 1, highest = 0;
  for (int k = 0; k < 10000; ++k) {
    reading.follow(flow_m3_per_s, 1e-4);
    const double value = reading.reading_m3_per_s();
    sum += value;
    lowest = std::min(lowest, value);
    highest = std::max(highest, value);
  }
  EXPECT_NEAR(sum / 10000, flow_m3_per_s, 1e-6 * flow_m3_per_s);
  EXPECT_NEAR(highest / flow_m3_per_s, 1.02, 1e-3);
  EXPECT_NEAR(lowest / flow_m3_per_s, 0.98, 1e-3);
}

TEST(Transducer, AveragesItsNoiseAwayOverManyConversions) {
  Transducer transducer({.noise = 1.0}, 1, "any", 0);
  double square = 0;
  for (int k = 0; k < 20000; ++k) {
    const double reading = transducer.reading(0.1);
    square += reading * reading;
  }
  EXPECT_NEAR(std::sqrt(square / 20000), 0.1, 0.003);
}

TEST(Transducer, AddsGainAndOffset) {
  Transducer transducer({.gain_error = 0.01, .offset = 0.5}, 1, "any", 0);
  transducer.follow(100, 1e-3);
  EXPECT_DOUBLE_EQ(transducer.reading(), 101.5);
}

TEST(Instruments, StateEveryFigureInsideItsOwnRange) {
  const Instruments instruments;
  EXPECT_NO_THROW(check_ranges(instruments));
}

}  // namespace
}  // namespace spoolflow::rig
