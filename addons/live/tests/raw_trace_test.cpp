#include "addons/live/valve/raw_trace.hpp"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace spoolflow::live {
namespace {

using ::testing::StartsWith;

estimation::TimedSample raw_sample(double time_s) {
  return {time_s, 1.5, estimation::not_measured, 1e-3, 323.15};
}

std::size_t raw_rows(const std::string& csv) {
  return csv.empty() ? 0 : static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')) - 1;
}

TEST(RawTrace, KeepsTheNewestAndLeavesOutWhatNobodyMeasured) {
  RawTrace trace(false, 2.0);
  for (int k = 0; k < 10000; ++k) trace.add(raw_sample(0.001 * k));
  const std::string csv = trace.csv(0, 100);
  EXPECT_THAT(csv, StartsWith("time_s,current_A,position_mm,oil_temperature_C\n7.999000,1.500000,1.000000,50.000\n"));
  EXPECT_EQ(raw_rows(csv), 2001U);
  EXPECT_EQ(raw_rows(trace.csv(8.5, 9.0)), 501U);
  EXPECT_EQ(trace.csv(20, 30), "");
}

TEST(RawTrace, ItsTimeNeverRunsBack) {
  RawTrace trace(false, 10.0);
  for (int k = 0; k < 100; ++k) trace.add(raw_sample(5 + 0.001 * k));
  trace.add(raw_sample(NAN));
  for (int k = 0; k < 50; ++k) trace.add(raw_sample(0.001 * k));
  EXPECT_EQ(raw_rows(trace.csv(0, 10)), 50U);
}

TEST(RawTrace, SlowAndLeapingSamplesKeepTheirTimes) {
  RawTrace trace(false, 3600.0);
  for (int k = 0; k < 100; ++k) trace.add(raw_sample(1e6 + 30.0 * k));
  EXPECT_EQ(raw_rows(trace.csv(0, 1e9)), 100U);
  EXPECT_THAT(trace.csv(1e6 + 2970, 1e9), ::testing::HasSubstr("\n1002970.000000,"));
  trace.add(raw_sample(2e6));
  EXPECT_EQ(raw_rows(trace.csv(0, 1e9)), 1U);
}

TEST(RawTrace, OfAWholeValveBothCoilsAreKept) {
  RawTrace trace(true, 10.0);
  estimation::TimedSample sample = raw_sample(1);
  sample.current_a_A = 0.25;
  trace.add(sample);
  EXPECT_EQ(
      trace.csv(0, 2),
      "time_s,current_b_A,position_mm,oil_temperature_C,current_a_A\n1.000000,1.500000,1.000000,50.000,0.250000\n");
}

TEST(RawTrace, KeepsNothingWhereNothingIsAskedFor) {
  RawTrace trace(false, 0);
  trace.add(raw_sample(1));
  EXPECT_EQ(trace.csv(0, 2), "");
}

}  // namespace
}  // namespace spoolflow::live
