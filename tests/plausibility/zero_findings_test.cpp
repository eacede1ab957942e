/// Recordings of one valve whose positions count from different zeros are named by flow, spring and rest; sound ones
/// raise nothing.
#include "spoolflow/plausibility/zero_findings.hpp"

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/plausibility/block_means.hpp"
#include "tests/plausibility/example_campaign.hpp"
#include "tests/plausibility/finding_texts.hpp"
#include "tests/plausibility/rig_benches.hpp"

namespace spoolflow::plausibility {
namespace {

using recording::Channel;
using recording::Recording;

constexpr double tenth_mm = 1e-4;

/// Two valves on which no limit was chosen, and the example's valve.
const std::vector<RigBenches>& valves() {
  static const std::vector<RigBenches> out{rig_benches("size_6", 33), rig_benches("size_10", 31), example_benches()};
  return out;
}

void add(Recording& recording, double offset_m) {
  for (double& position_m : recording.column(Channel::position)) position_m += offset_m;
}

/// What is said of the campaign with one recording's zero moved.
std::string said_of(const RigBenches& valve, const std::string& file, double offset_m) {
  RigBenches changed = valve;
  add(changed.recordings.at(file), offset_m);
  return all_texts(campaign_findings(changed.benches()));
}

std::string run_of(const RigBenches& valve) {
  for (const auto& [file, recording] : valve.recordings) {
    if (file.starts_with("ramp")) return file;
  }
  return {};
}

TEST(ZeroFindings, AreNoneOfSoundCampaigns) {
  for (const RigBenches& valve : valves())
    EXPECT_THAT(all_texts(campaign_findings(valve.benches())), testing::IsEmpty());
}

TEST(ZeroFindings, NameARunWhosePositionIsATenthOfAMillimetreOff) {
  for (const RigBenches& valve : valves()) {
    const std::string run = run_of(valve);
    EXPECT_THAT(said_of(valve, run, tenth_mm),
                testing::ContainsRegex(run + ": position reads (0.1|0.09)[0-9]* mm more than in the axial-force maps"));
    EXPECT_THAT(said_of(valve, run, -tenth_mm),
                testing::ContainsRegex(run + ": position reads (0.1|0.09)[0-9]* mm less than in the axial-force maps"));
  }
}

TEST(ZeroFindings, NameTheMapWhosePositionIsATenthOfAMillimetreOffTheOthers) {
  const RigBenches& example = valves().back();
  for (const std::string map : {"axial_force_map_30.h5", "axial_force_map_50.h5", "axial_force_map_70.h5"}) {
    const std::string said = said_of(example, map, tenth_mm);
    EXPECT_THAT(said, testing::ContainsRegex(map + ": position reads (0.1|0.09).* mm more than in the other axial"));
    EXPECT_EQ(said.find('\n'), said.size() - 1) << "said more than that:\n" << said;
  }
}

TEST(ZeroFindings, NameASpringRecordingWhosePositionIsATenthOfAMillimetreOff) {
  for (const RigBenches* valve : {&valves().front(), &valves().back()}) {
    const std::string spring = valve->recordings.contains("spring.csv") ? "spring.csv" : "spring.h5";
    EXPECT_THAT(said_of(*valve, spring, tenth_mm), testing::HasSubstr(spring + ": position reads 0."));
    EXPECT_THAT(said_of(*valve, spring, -tenth_mm), testing::HasSubstr(spring + ": position reads 0."));
  }
}

TEST(ZeroFindings, NameAPositionAtRestWithoutCurrentThatIsNotZeroWhereNobodyMeasuredTheFlow) {
  for (const RigBenches& valve : valves()) {
    const std::vector<KnownValve> known{known_valve(valve.benches())};
    Recording run = valve.recordings.at(run_of(valve));
    for (const Channel other : {Channel::flow_reference, Channel::pressure_difference}) run.column(other).clear();
    EXPECT_THAT(all_texts(run_findings(known, means_of(run), "run.csv")), testing::IsEmpty());
    add(run, tenth_mm);
    EXPECT_THAT(all_texts(run_findings(known, means_of(run), "run.csv")),
                testing::ContainsRegex("run.csv: position is .0.1.. mm at rest without current"));
  }
}

TEST(ZeroFindings, NameARunThroughTheCentreWhoseZeroIsATenthOfAMillimetreOff) {
  const RigBenches& valve = valves().front();
  const std::vector<KnownValve> known{known_valve(valve.benches()), known_valve(valve.benches())};
  Recording run = both_sides(valve.recordings.at(run_of(valve)));
  EXPECT_THAT(all_texts(run_findings(known, means_of(run), "run.csv")), testing::IsEmpty());
  add(run, tenth_mm);
  EXPECT_THAT(all_texts(run_findings(known, means_of(run), "run.csv")),
              testing::AllOf(testing::ContainsRegex("(0.1|0.09).* mm more than in the axial-force maps of P to B"),
                             testing::ContainsRegex("(0.1|0.09).* mm less than in the axial-force maps of P to A")));
}

/// A meter beside a valve that closes at 5 s for two seconds, passes 60 L/min before, and opens again.
Recording metered(const std::function<double(double closed_s)>& shown_L_min) {
  Recording run;
  for (int k = 0; k < 1000; ++k) {
    const double time_s = 0.01 * k, closed_s = time_s - 5;
    const bool closed = closed_s >= 0 && closed_s < 2;
    run.column(Channel::time).push_back(time_s);
    run.column(Channel::position).push_back(closed ? 0.05e-3 : 1.5e-3);
    run.column(Channel::flow).push_back(units::m3_per_s_from_L_per_min(closed ? shown_L_min(closed_s) : 60));
  }
  return run;
}

TEST(ZeroFindings, NameAMeterThatShowsAnOffsetBehindTheClosedValve) {
  KnownValve valve{};
  valve.closed_below_m = 0.2e-3;
  valve.hydraulics.largest_flow_m3_per_s = units::m3_per_s_from_L_per_min(80);
  const std::vector<KnownValve> valves{valve};
  for (const double offset_L_min : {1.5, -1.5}) {
    const auto finding = meter_zero_finding(metered([&](double) { return offset_L_min; }), valves);
    ASSERT_TRUE(finding);
    EXPECT_THAT(finding->text, testing::HasSubstr(offset_L_min > 0 ? "flow_reference stands at 1.5 L/min, 1.9 %"
                                                                   : "flow_reference stands at -1.5 L/min, -1.9 %"));
  }
  const auto leaks = [](double) { return 0.3; };
  const auto changes = [](double closed_s) { return 1.5 + 0.6 * std::sin(3 * closed_s); };
  const auto slow_meter = [](double closed_s) { return 60 * std::exp(-closed_s / 0.5); };
  EXPECT_FALSE(meter_zero_finding(metered(leaks), valves));
  EXPECT_FALSE(meter_zero_finding(metered(changes), valves));
  EXPECT_FALSE(meter_zero_finding(metered(slow_meter), valves));
}

TEST(ZeroFindings, NameEdgesOfBothDirectionsThatOpenAtDifferentDistancesFromTheCentre) {
  const RigBenches& valve = valves().front();
  Recording map = block_means(valve.recordings.at("axial_force_map_50.csv"), 1000);
  const OpeningCurve b({&map}, valve.stroke_m);
  EXPECT_FALSE(centre_finding(b, b, valve.stroke_m).has_value());
  add(map, -tenth_mm);
  const auto finding = centre_finding(b, OpeningCurve({&map}, valve.stroke_m), valve.stroke_m);
  ASSERT_TRUE(finding.has_value());
  EXPECT_THAT(finding->text, testing::HasSubstr("from the centre: the zero of the position sensor is off"));
}

}  // namespace
}  // namespace spoolflow::plausibility
