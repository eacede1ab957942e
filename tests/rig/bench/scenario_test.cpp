#include "spoolflow/rig/bench/scenario.hpp"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/recording/temporary_file.hpp"

namespace spoolflow::rig {
namespace {

Scenario scenario_of(const std::string& text) {
  return read_scenario(recording::TemporaryFile("scenario.toml", text).path());
}

std::string refusal_of(const std::string& text) {
  try {
    static_cast<void>(scenario_of(text));
  } catch (const SettingsError& error) {
    return error.what();
  }
  return "taken";
}

TEST(Scenario, ABenchTestOfDirectionAHasTheValveTurnedRound) {
  const PlannedScenario b = plan(scenario_of("protocol = \"spring\"\nvalve = \"whole_size_6\"\n"));
  const PlannedScenario a = plan(scenario_of("protocol = \"spring\"\nvalve = \"whole_size_6\"\ndirection = \"a\"\n"));
  EXPECT_EQ(a.valve.plant.spring_b.preload_N, b.valve.plant.spring_a.preload_N);
  EXPECT_EQ(a.valve.plant.solenoid_b.coil.resistance_20C_ohm, b.valve.plant.solenoid_a.coil.resistance_20C_ohm);
  EXPECT_EQ(a.valve.instruments.lvdt.zero_offset_m, -b.valve.instruments.lvdt.zero_offset_m);
  EXPECT_EQ(b.run.load, LoadKind::held_path);
}

TEST(Scenario, AnEdgeSaysWhichPortIsFedAndWhichWayTheValveLies) {
  const std::string map = "protocol = \"axial_force_map\"\nvalve = \"whole_size_6\"\nedge = ";
  EXPECT_EQ(scenario_of(map + "\"AT\"\n").direction_a, false);
  EXPECT_EQ(scenario_of(map + "\"BT\"\n").direction_a, true);
  EXPECT_EQ(plan(scenario_of(map + "\"BT\"\n")).run.load, LoadKind::held_return);
  EXPECT_EQ(plan(scenario_of(map + "\"PA\"\n")).run.load, LoadKind::held_difference);
}

TEST(Scenario, OperationOfAWholeValveTakesNegativePositionsAndPortPressures) {
  const PlannedScenario planned =
      plan(scenario_of("protocol = \"steps\"\nvalve = \"whole_size_6\"\n[run]\npositions_percent = [-60]\n"
                       "[run.conditions]\nport_pressures = true\n"));
  EXPECT_TRUE(planned.run.whole_valve);
  EXPECT_DOUBLE_EQ(planned.run.position_set.last(), -0.6);
  EXPECT_THAT(planned.run.channels,
              testing::IsSupersetOf({recording::Channel::current_a, recording::Channel::pressure_t}));
}

TEST(Scenario, IsRefusedWhereItIsNoneOrNestsWithoutEnd) {
  using testing::HasSubstr;
  EXPECT_THAT(refusal_of("valve = \"size_6\"\n"), HasSubstr("protocol is missing"));
  EXPECT_THAT(refusal_of("protocol = 3\n"), HasSubstr("protocol must be text in quotes"));
  EXPECT_THAT(refusal_of("protocol = \"ramp\"\n"), HasSubstr("choose one of"));
  EXPECT_THAT(refusal_of("protocol = \n"), HasSubstr("line 1"));
  std::string dotted = "a";
  for (int k = 0; k < 40000; ++k) dotted += ".a";
  EXPECT_THAT(refusal_of("protocol = \"ramps\"\n" + dotted + " = 1\n"), HasSubstr("line 2: nests deeper"));
  EXPECT_THAT(refusal_of("protocol = \"ramps\"\n[" + dotted + "]\n"), HasSubstr("line 2: nests deeper"));
}

TEST(Scenario, RefusesDirectionsAndEdgesThatDoNotFit) {
  using testing::HasSubstr;
  EXPECT_THAT(refusal_of("protocol = \"ramps\"\ndirection = \"a\"\n"), HasSubstr("direction is of bench tests"));
  EXPECT_THAT(refusal_of("protocol = \"ramps\"\nedge = \"PB\"\n"), HasSubstr("edge is of the protocols"));
  EXPECT_THAT(refusal_of("protocol = \"spring\"\ndirection = \"a\"\nedge = \"AT\"\n"),
              HasSubstr("\"AT\" opens in direction b"));
  EXPECT_THAT(refusal_of("protocol = \"spring\"\nedge = \"TB\"\n"), HasSubstr("path, PB, AT, PA, BT"));
}

TEST(Scenario, AMachineIsRoundTheValveAtWorkAndOnNoBench) {
  using testing::HasSubstr;
  const std::string shaken = "[machine.vibration]\nacceleration_g = 1.5\n";
  EXPECT_EQ(plan(scenario_of("protocol = \"ramps\"\n" + shaken)).run.machine.vibration.acceleration_g, 1.5);
  EXPECT_EQ(plan(scenario_of("protocol = \"ramps\"\n")).run.machine, Machine{});
  EXPECT_THAT(refusal_of("protocol = \"spring\"\n" + shaken), HasSubstr("[machine] is of the valve at work"));
  EXPECT_THAT(refusal_of("protocol = \"ramps\"\n[machine.ripple]\namplitude_bar = 30\n"), HasSubstr("line 3"));
  EXPECT_THAT(refusal_of("protocol = \"ramps\"\n[machine.ripple]\namplitude_Pa = 3\n"), HasSubstr("amplitude_bar"));
  EXPECT_THAT(
      refusal_of("protocol = \"ramps\"\n[plant.load]\nkind = \"motor\"\n[machine.actuator_end]\nstands_s = 1\n"),
      HasSubstr("machine.actuator_end is of loads that hold"));
}

TEST(Scenario, OneValveOfASeriesRunsWithManySeeds) {
  const std::string drawn = "protocol = \"duty_cycle\"\n[spread]\namount = 1\nseed = 41\n";
  const PlannedScenario one = plan(scenario_of("seed = 3\n" + drawn)), other = plan(scenario_of("seed = 4\n" + drawn));
  EXPECT_EQ(one.valve.plant.spring_b.preload_N, other.valve.plant.spring_b.preload_N);
  EXPECT_NE(one.valve.plant.spring_b.preload_N, ValveUnderTest{}.plant.spring_b.preload_N);
  EXPECT_NE(one.run.position_set.at(5), other.run.position_set.at(5));
}

TEST(Scenario, ASeedOfTheSeriesThatDrawsNothingIsRefused) {
  EXPECT_THAT(refusal_of("protocol = \"ramps\"\n[spread]\nseed = 41\n"), ::testing::HasSubstr("add amount = 1"));
}

}  // namespace
}  // namespace spoolflow::rig
