/// How units of a type differ, as [tolerances] of a campaign states it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/calibration/numerics/calibration_error.hpp"
#include "spoolflow/calibration/type/type_model.hpp"

namespace spoolflow::calibration {
namespace {

using testing::HasSubstr;

TEST(TypeModel, TolerancesAreReadInTheirUnitsAndUnknownOnesRefusedByLine) {
  EXPECT_DOUBLE_EQ(tolerances_from({"", {{"edge_position_um", 12}}})[at(Variation::edge_position)], 12e-6);
  try {
    (void)tolerances_from({"campaign.toml, line 9",
                           {{"edge_position", 12}, {"spring_rate", 0.02}},
                           {{"edge_position", "campaign.toml, line 11"}, {"spring_rate", "campaign.toml, line 10"}}});
    FAIL() << "a length without its unit passed";
  } catch (const CalibrationError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("campaign.toml, line 11: unknown key 'edge_position' in [tolerances]; did you mean "
                          "'edge_position_um'?; allowed: turns"));
  }
  EXPECT_THROW((void)tolerances_from({"", {{"spring_rate", 2}}}), CalibrationError);  // percent for a share
  EXPECT_THROW((void)tolerances_from({"", {{"turns", 0.3}}}), CalibrationError);
  try {
    (void)tolerances_from({"campaign.toml, line 9", {{"edge_position_um", 0.008}}});
    FAIL() << "millimetres for micrometres passed";
  } catch (const CalibrationError& error) {
    EXPECT_STREQ(error.what(),
                 "campaign.toml, line 9: edge_position_um = 0.008 is not between 0.04 and 50; give one standard "
                 "deviation between units of a type, in um, where it stands in mm times 1000");
  }
}

}  // namespace
}  // namespace spoolflow::calibration
