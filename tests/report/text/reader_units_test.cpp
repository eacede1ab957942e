#include "spoolflow/report/text/reader_units.hpp"

#include <gtest/gtest.h>

namespace spoolflow::report {
namespace {

TEST(ReaderUnits, AreTheUsualOnesUntilOthersAreAskedFor) {
  EXPECT_EQ(ReaderUnits().unit(units::Kind::pressure).shown, "bar");
  EXPECT_EQ(ReaderUnits({"bar", "m3/h"}).unit(units::Kind::flow).shown, "m\u00b3/h");
  EXPECT_DOUBLE_EQ(ReaderUnits({"m3/h"}).value(units::flow(1 / 3600.0)), 1);
  EXPECT_EQ(choice_of_units(), "L/min|m3/h|gal/min, bar|MPa|psi, mm|um|in, N|lbf, C|F");
}

TEST(ReaderUnits, WriteDifferencesOfTemperaturesWithoutTheOffsetOfTemperatures) {
  const ReaderUnits american({"F"});
  EXPECT_DOUBLE_EQ(american.value(units::temperature(273.15)), 32);
  EXPECT_DOUBLE_EQ(american.value(units::temperature_difference(10)), 18);
  EXPECT_EQ(american.unit(units::Kind::temperature_difference).shown, "\u00b0F");
  EXPECT_EQ(ReaderUnits().unit(units::Kind::temperature_difference).shown, "K");
}

TEST(ReaderUnits, RefuseWhatTheyDoNotKnow) {
  EXPECT_THROW(ReaderUnits({"furlong"}), UnknownUnit);
  EXPECT_THROW(ReaderUnits({"bar", "psi"}), UnknownUnit);
  EXPECT_THROW(ReaderUnits({""}), UnknownUnit);
}

TEST(ReaderUnits, GiveThePagesScriptItsStart) {
  EXPECT_EQ(ReaderUnits({"bar"}).attributes(), "");
  EXPECT_EQ(ReaderUnits({"psi", "in"}).attributes(), " data-pressure-unit=\"2\" data-position-unit=\"2\"");
}

}  // namespace
}  // namespace spoolflow::report
