#include "spoolflow/calibration/flow_bench/contradictions.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/calibration/flow_bench/equivalent_benches.hpp"

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

/// The flow with the spool closed, by the pressure difference [Pa].
template <class Leakage>
std::vector<std::string> with_closed_flow(const Leakage& of_Pa) {
  recording::Recording out = metering();
  for (std::size_t k = 0; k < out.size(); ++k) {
    double& position_m = out.column(Channel::position)[k];
    double& flow_m3_per_s = out.column(Channel::flow_reference)[k];
    if (position_m < 3e-4) position_m = flow_m3_per_s = 0;  // it rests there
    flow_m3_per_s += of_Pa(out.column(Channel::pressure_difference)[k]);
  }
  return contradictions_of({{}, {&out}, {}}, figures);
}

TEST(FlowBenchContradictions, NameAMetersZeroAndNoLeakage) {
  constexpr double litre_per_minute = 1 / 60e3;
  EXPECT_THAT(with_closed_flow([](double) { return 2 * litre_per_minute; }),
              ElementsAre(HasSubstr("channel flow_reference is 2 L/min while the spool is closed")));
  EXPECT_THAT(with_closed_flow([](double) { return -2 * litre_per_minute; }), ElementsAre(HasSubstr("is -2 L/min")));
  EXPECT_THAT(with_closed_flow([](double Pa) { return 2 * litre_per_minute * std::sqrt(Pa / 6e6); }), IsEmpty());
}

TEST(FlowBenchScale, IsDoubtedWhereForcesAreHalfThoseOfAJet) {
  EXPECT_EQ(doubtful_scale(0.8), "");
  EXPECT_EQ(doubtful_scale(1.1), "");
  EXPECT_EQ(doubtful_scale(std::nan("")), "");
  EXPECT_THAT(doubtful_scale(0.5), HasSubstr("makes the flow force 0.5 times that of a jet"));
  EXPECT_THAT(doubtful_scale(2), HasSubstr("the scale of the voltage, of the current or of the flow meter is wrong"));
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
