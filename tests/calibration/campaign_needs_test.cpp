/// What is missing for which kind of model.
#include "spoolflow/calibration/campaign_needs.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/calibration/numerics/calibration_error.hpp"

namespace spoolflow::calibration {
namespace {

using recording::Channel;
using recording::Protocol;
using recording::Recording;
using testing::ElementsAre;
using testing::IsEmpty;

/// Strokes of that length, one at each pressure difference.
Recording strokes(const std::vector<double>& pressures_Pa, double stroke_s) {
  constexpr int samples = 400;
  Recording out;
  double time_s = 0;
  for (const double pressure_Pa : pressures_Pa) {
    for (int k = 0; k < samples; ++k) {
      const double opening = 1 - std::abs(2.0 * k / samples - 1);
      out.column(Channel::time).push_back(time_s += 2 * stroke_s / samples);
      out.column(Channel::position).push_back(2.4e-3 * opening);
      out.column(Channel::current).push_back(0.6 + opening);
      out.column(Channel::voltage).push_back(3 * (0.6 + opening));
      out.column(Channel::pressure_difference).push_back(pressure_Pa);
      out.column(Channel::flow_reference).push_back(1e-6 * opening * std::sqrt(pressure_Pa));
      out.column(Channel::oil_temperature).push_back(323.15);
    }
  }
  return out;
}

std::vector<Protocol> protocols(const std::vector<NeededRecording>& needed) {
  std::vector<Protocol> out;
  for (const NeededRecording& each : needed) out.push_back(each.protocol);
  return out;
}

TEST(CampaignNeeds, StrokesAreRecognisedByPressureAndPace) {
  const Recorded metering = recognised(strokes({1e6, 3e6, 6e6}, 12));
  EXPECT_EQ(metering.protocol, Protocol::metering);
  EXPECT_EQ(metering.levels, 3);
  EXPECT_TRUE(metering.voltage);
  EXPECT_NEAR(metering.oil_temperature_K, 323.15, 1e-6);
  EXPECT_EQ(recognised(strokes({0, 0}, 12)).protocol, Protocol::unpressurised_strokes);
  EXPECT_EQ(recognised(strokes({1e6, 3e6, 6e6}, 0.3)).protocol, Protocol::operation) << "faster than a stroke is slow";
  EXPECT_EQ(recognised(strokes({6e6, 6e6, 6e6}, 12)).protocol, Protocol::operation) << "at one pressure difference";
}

TEST(CampaignNeeds, ForceRecordingsAreRecognisedByWhatMoves) {
  Recording axial = strokes({1e6, 3e6}, 12);
  axial.column(Channel::axial_force).assign(axial.size(), 20);
  EXPECT_EQ(recognised(axial).protocol, Protocol::axial_force_map);
  axial.column(Channel::pressure_difference).assign(axial.size(), 0);
  EXPECT_EQ(recognised(axial).protocol, Protocol::spring);
  Recording map = strokes({0, 0, 0}, 12);
  map.column(Channel::force).assign(map.size(), 20);
  Recording dynamic = map;
  map.column(Channel::current).assign(map.size(), 1.3);
  dynamic.column(Channel::position).assign(dynamic.size(), 1e-3);
  EXPECT_EQ(recognised(map).protocol, Protocol::solenoid_force_map);
  EXPECT_EQ(recognised(dynamic).protocol, Protocol::solenoid_dynamic);
}

TEST(CampaignNeeds, ARecordingWithoutAnyForceOrCurrentServesNoTest) {
  Recording nothing = strokes({1e6}, 12);
  nothing.column(Channel::current).clear();
  EXPECT_THROW((void)recognised(nothing), CalibrationError);
}

TEST(CampaignNeeds, OfNothingAreAllTestsOfEachKind) {
  const std::vector<ModelNeeds> needs = needs_of({});
  ASSERT_EQ(needs.size(), 3U);
  EXPECT_THAT(protocols(needs[0].missing),
              ElementsAre(Protocol::spring, Protocol::solenoid_force_map, Protocol::axial_force_map));
  EXPECT_THAT(protocols(needs[1].missing), ElementsAre(Protocol::unpressurised_strokes, Protocol::metering));
  EXPECT_THAT(protocols(needs[2].missing), ElementsAre(Protocol::unpressurised_strokes));
  EXPECT_DOUBLE_EQ(needs[1].missing_minutes(), 5.5);
}

TEST(CampaignNeeds, AFlowBenchIsWholeWithStrokesAndLacksTheMagneticForceWithoutVoltage) {
  Recorded dry = recorded_by(strokes({0, 0}, 12), Protocol::unpressurised_strokes);
  Recorded metering = recorded_by(strokes({1e6, 3e6, 6e6}, 12), Protocol::metering);
  EXPECT_THAT(needs_of({dry, metering})[1].missing, IsEmpty());
  EXPECT_THAT(protocols(needs_of({dry, metering})[1].better), ElementsAre(Protocol::metering, Protocol::operation))
      << "at more oil temperatures, and the valve at work";
  EXPECT_DOUBLE_EQ(needs_of({dry, metering})[1].better.front().minutes, 8) << "two of them";
  metering.voltage = false;
  EXPECT_THAT(protocols(needs_of({dry, metering})[1].missing), ElementsAre(Protocol::metering));
  const Recorded map{Protocol::solenoid_force_map};
  EXPECT_THAT(needs_of({dry, metering, map})[1].missing, IsEmpty()) << "a force map shows it as well";
}

TEST(CampaignNeeds, AFlowBenchAloneIsNoForceBenchAndTakesTheirPlaceBesideOne) {
  const Recorded dry = recorded_by(strokes({0, 0}, 12), Protocol::unpressurised_strokes);
  const Recorded metering = recorded_by(strokes({1e6, 3e6, 6e6}, 12), Protocol::metering);
  EXPECT_THAT(protocols(needs_of({dry, metering})[0].missing),
              ElementsAre(Protocol::spring, Protocol::solenoid_force_map, Protocol::axial_force_map));
  const Recorded map{Protocol::solenoid_force_map};
  EXPECT_THAT(needs_of({dry, metering, map})[0].missing, IsEmpty());
}

TEST(CampaignNeeds, ASecondDirectionNeedsItsOwn) {
  Recorded dry = recorded_by(strokes({0, 0}, 12), Protocol::unpressurised_strokes);
  Recorded metering = recorded_by(strokes({1e6, 3e6, 6e6}, 12), Protocol::metering);
  Recorded other = dry;
  other.direction = "a";
  const std::vector<ModelNeeds> needs = needs_of({dry, metering, other});
  ASSERT_THAT(protocols(needs[1].missing), ElementsAre(Protocol::metering));
  EXPECT_EQ(needs[1].missing.front().direction, "a");
}

}  // namespace
}  // namespace spoolflow::calibration
