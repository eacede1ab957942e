#include "spoolflow/rig/bench/valve_under_test.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/rig/bench/virtual_campaign.hpp"

namespace spoolflow::rig {
namespace {

/// The valve of a file with that text, on the size-6 preset.
ValveUnderTest with(const std::string& text) {
  ValveUnderTest valve = valve_preset("size_6");
  Settings settings;
  add_valve_settings(settings, valve);
  apply({.text = text, .name = "valve.toml"}, settings);
  return valve;
}

TEST(ValveUnderTest, ItsFileChoosesTheHysteresisOfBothSolenoids) {
  const std::pair<const char*, HysteresisKind> kinds[] = {{"jiles_atherton", HysteresisKind::jiles_atherton},
                                                          {"preisach", HysteresisKind::preisach}};
  for (const auto& [name, kind] : kinds) {
    const ValveUnderTest valve = with(std::string("hysteresis = \"") + name + "\"\n");
    EXPECT_EQ(valve.plant.solenoid_a.hysteresis.kind, kind);
    EXPECT_EQ(valve.plant.solenoid_b.hysteresis.kind, kind);
  }
  try {
    static_cast<void>(with("hysteresis = \"prandtl\"\n"));
    FAIL() << "taken";
  } catch (const SettingsError& error) {
    EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("valve.toml, line 1"), testing::HasSubstr("prandtl"),
                                             testing::HasSubstr("jiles_atherton, preisach")));
  }
}

TEST(ValveUnderTest, ItsFileShapesTheHysteresis) {
  const ValveUnderTest valve = with(
      "[plant.solenoid_b.hysteresis]\ncoercive_field_A_per_m = 90\n"
      "[plant.solenoid_b.hysteresis.preisach]\ncoercive_spread = 0.5\n"
      "[plant.solenoid_b.hysteresis.jiles_atherton]\nreversible_share = 0.3\n");
  EXPECT_EQ(valve.plant.solenoid_b.hysteresis.coercive_field_A_per_m, 90);
  EXPECT_EQ(valve.plant.solenoid_b.hysteresis.preisach.coercive_spread, 0.5);
  EXPECT_EQ(valve.plant.solenoid_b.hysteresis.jiles_atherton.reversible_share, 0.3);
}

TEST(ValveUnderTest, ThePresetsHoldBothKindsOfHysteresis) {
  std::set<HysteresisKind> kinds;
  for (const std::string& preset : valve_presets())
    kinds.insert(read_valve_and_campaign(preset).valve.plant.solenoid_b.hysteresis.kind);
  EXPECT_EQ(kinds.size(), 2U);
}

TEST(ValveUnderTest, StictionGrowsAtATimeOfItsOwnInEveryValveOfASeries) {
  std::vector<double> shares;  // of the nominal time, as powers of the largest factor
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    ValveUnderTest nominal = valve_preset("size_6");
    nominal.seed = seed;
    EXPECT_EQ(as_built(nominal).plant.spool_friction.ageing_time_s, nominal.plant.spool_friction.ageing_time_s);
    nominal.spread.amount = 1;
    const ValveUnderTest built = as_built(nominal);
    const double factor = built.plant.spool_friction.ageing_time_s / nominal.plant.spool_friction.ageing_time_s;
    EXPECT_NEAR(built.plant.solenoid_b.friction.ageing_time_s / nominal.plant.solenoid_b.friction.ageing_time_s, factor,
                1e-9);
    shares.push_back(std::log(factor) / std::log(nominal.spread.ageing_time));
  }
  std::sort(shares.begin(), shares.end());
  EXPECT_GE(shares.front(), -1);
  EXPECT_LE(shares.back(), 1);
  for (const int k : {20, 60, 100, 140, 180}) {
    EXPECT_NEAR(shares[static_cast<std::size_t>(k)], k / 100.0 - 1, 0.15) << k;  // even over the logarithm
  }
}

}  // namespace
}  // namespace spoolflow::rig
