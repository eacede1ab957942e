#include "spoolflow/calibration/unpressurised_strokes.hpp"

#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace spoolflow::calibration {
namespace {

using recording::Channel;
using testing::HasSubstr;

constexpr double whole_stroke_m = 2.4e-3;
constexpr double rated_m3_per_s = 80 / 60e3;

/// One slow stroke of so much of the whole, under a pressure difference and the flow it drives.
recording::Recording strokes(double share, double pressure_Pa, double flow_m3_per_s) {
  recording::Recording out;
  out.file = "strokes.csv";
  for (int k = 0; k <= 200; ++k) {
    out.column(Channel::time).push_back(0.1 * k);
    out.column(Channel::position).push_back(share * whole_stroke_m * (1 - std::abs(k - 100) / 100.0));
    out.column(Channel::current).push_back(0.5);
    out.column(Channel::pressure_difference).push_back(pressure_Pa);
    out.column(Channel::flow_reference).push_back(flow_m3_per_s);
  }
  return out;
}

std::string refusal(const recording::Recording& recording) {
  return not_unpressurised(recording, rated_m3_per_s, whole_stroke_m);
}

TEST(UnpressurisedStrokes, ServeWithAndWithoutInstrumentsThatReadZero) {
  EXPECT_EQ(refusal(strokes(1, 2e3, 1e-7)), "");
  recording::Recording bare = strokes(1, 0, 0);
  bare.column(Channel::pressure_difference).clear();
  bare.column(Channel::flow_reference).clear();
  EXPECT_EQ(refusal(bare), "");
}

TEST(UnpressurisedStrokes, OfAValveUnderPressureAreRefusedByChannelAndValue) {
  EXPECT_THAT(refusal(strokes(1, 60e5, 0)), HasSubstr("strokes.csv: channel pressure_difference is 60.0 bar"));
  EXPECT_THAT(refusal(strokes(1, 0, 0.5 * rated_m3_per_s)), HasSubstr("channel flow_reference is 40.00 L/min"));
}

TEST(UnpressurisedStrokes, ThatLeaveHalfTheSpringUnseenAreRefused) {
  EXPECT_THAT(refusal(strokes(0.4, 0, 0)), HasSubstr("opens by 0.96 mm and closes by 0.96 mm at most"));
}

}  // namespace
}  // namespace spoolflow::calibration
