#include "spoolflow/recording/files/header_name.hpp"

#include <string>

#include <gtest/gtest.h>

namespace spoolflow::recording {
namespace {

std::string unit_in(std::string_view name) {
  return std::string(split_unit(name).unit);
}

TEST(HeaderName, FindsTheUnitWhereverItStandsInAName) {
  EXPECT_EQ(unit_in("I_sol [mA]"), "mA");
  EXPECT_EQ(unit_in("Current (mA) - Plot 0"), "mA");
  EXPECT_EQ(unit_in("Position [mm] ch3"), "mm");
  EXPECT_EQ(unit_in("I_coil mA"), "mA");
  EXPECT_EQ(unit_in("Temp (degC), filtered"), "degC");
  EXPECT_EQ(unit_in("Temp degC, filtered"), "degC");
  EXPECT_EQ(unit_in("Oil deg C"), "deg C");
  EXPECT_EQ(unit_in("Current in mA"), "mA");
  EXPECT_EQ(unit_in("C1 in A"), "A");
  EXPECT_EQ(unit_in("Pressure, bar"), "bar");
  EXPECT_EQ(unit_in("I / mA"), "mA");
  EXPECT_EQ(unit_in("p1/bar"), "bar");
  EXPECT_EQ(unit_in("U/V"), "V");
  EXPECT_EQ(unit_in("Q L/min"), "L/min");
  EXPECT_EQ(unit_in("Pressure (A) [bar]"), "bar");
  EXPECT_EQ(split_unit("Current (mA) - Plot 0").stem, "Current");
  EXPECT_EQ(split_unit("Current in mA").stem, "Current");
}

TEST(HeaderName, TakesNoIndexAndNoWordOfSeveralMeaningsForAUnit) {
  for (const char* name : {"X(1,:)", "Signal[0]", "Signal[1]", "y(2)", "y(1)", "x(k)", "u(n)", "X(:,3)", "flow meter A",
                           "Current in coil", "second coil", "Coil A", "bench/V", "Sensor C", "Channel 1"})
    EXPECT_EQ(unit_in(name), "") << name;
  EXPECT_EQ(unit_in("position_set [1]"), "1");
}

TEST(HeaderName, KnowsARowOfUnitsFromARowOfNamesThatStateUnits) {
  EXPECT_TRUE(is_units_row({"s", "A", "mm"}));
  EXPECT_TRUE(is_units_row({"(ms)", "", "[V]", "rpm"}));
  EXPECT_FALSE(is_units_row({"time [s]", "current [A]"}));
  EXPECT_FALSE(is_units_row({"s", "1.5"}));
}

TEST(HeaderName, ReadsAUnitBesideTheNameWithItsQuantityBehindIt) {
  EXPECT_EQ(stated_unit({"u", "u", "V (voltage)"}), "V");
  EXPECT_EQ(stated_unit({"u", "u", "[mV]"}), "mV");
  EXPECT_EQ(stated_unit({"u", "u", "V"}), "V");
}

}  // namespace
}  // namespace spoolflow::recording
