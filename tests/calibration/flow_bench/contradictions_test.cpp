#include "spoolflow/calibration/flow_bench/contradictions.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace spoolflow::calibration {
namespace {

using recording::Channel;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr ValveFigures figures{80 / 60e3, 2.4e-3};

/// Two strokes at 10 and at 60 bar of a valve that passes its rated flow at 60 bar.
recording::Recording metering() {
  recording::Recording out;
  out.file = "metering.csv";
  for (int k = 0; k < 800; ++k) {
    const double opening = 1 - std::abs(k % 400 - 200) / 200.0, pressure_Pa = k < 400 ? 1e6 : 6e6;
    out.column(Channel::time).push_back(0.01 * k);
    out.column(Channel::position).push_back(2.4e-3 * opening);
    out.column(Channel::current).push_back(0.6 + opening);
    out.column(Channel::voltage).push_back(3 * (0.6 + opening));
    out.column(Channel::pressure_difference).push_back(pressure_Pa);
    out.column(Channel::flow_reference).push_back(80 / 60e3 * opening * std::sqrt(pressure_Pa / 6e6));
  }
  return out;
}

std::vector<std::string> after(Channel channel, double factor) {
  recording::Recording spoilt = metering();
  for (double& value : spoilt.column(channel)) value *= factor;
  return contradictions_of({{}, {&spoilt}, {}}, figures);
}

TEST(FlowBenchContradictions, AreNoneInASoundRecording) {
  EXPECT_THAT(after(Channel::flow_reference, 1), IsEmpty());
}

TEST(FlowBenchContradictions, NameTheChannelWhoseSignOrUnitIsWrong) {
  EXPECT_THAT(after(Channel::current, -1), ElementsAre(HasSubstr("channel current is")));
  EXPECT_THAT(after(Channel::current, 1e-3), ElementsAre(HasSubstr("its sign or unit is wrong")));
  EXPECT_THAT(after(Channel::voltage, -1), ElementsAre(HasSubstr("channel voltage over current is -3 Ohm")));
  EXPECT_THAT(after(Channel::voltage, 1e-3), ElementsAre(HasSubstr("channel voltage over current")));
  EXPECT_THAT(after(Channel::position, 1e-3), ElementsAre(HasSubstr("channel position hardly passes half the stroke")));
  EXPECT_THAT(after(Channel::pressure_difference, -1), ElementsAre(HasSubstr("its ports are swapped")));
  EXPECT_THAT(after(Channel::pressure_difference, 1e-3), ElementsAre(HasSubstr("channel pressure_difference is")));
  EXPECT_THAT(after(Channel::flow_reference, -1), ElementsAre(HasSubstr("channel flow_reference is")));
  EXPECT_THAT(after(Channel::flow_reference, 60), ElementsAre(HasSubstr("go with its rated flow")));
}

TEST(FlowBenchContradictions, NameTheTravelOfAPositionOfTheWrongSignAndACurrentThatIsMissing) {
  EXPECT_THAT(after(Channel::position, -1), ElementsAre(HasSubstr("it is -2.40 to 0.00 mm; its sign")));
  EXPECT_THAT(after(Channel::current, NAN), ElementsAre(HasSubstr("channel current has no values where the valve")));
}

TEST(FlowBenchContradictions, FindAPressureThatIsNotAcrossTheEdge) {
  recording::Recording spoilt = metering();
  for (double& value : spoilt.column(Channel::pressure_difference)) value += 4e6;  // of a port upstream
  EXPECT_THAT(contradictions_of({{}, {&spoilt}, {}}, figures), ElementsAre(HasSubstr("is not across the edges")));
}

}  // namespace
}  // namespace spoolflow::calibration
