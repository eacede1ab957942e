#include "spoolflow/rig/numerics/parameter.hpp"

#include <set>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/rig/plant/valve_plant.hpp"

namespace spoolflow::rig {
namespace {

TEST(RigParameter, DefaultValveLiesInsideEveryStatedRange) {
  EXPECT_NO_THROW(check_ranges(PlantParameters{}));
}

TEST(RigParameter, OutsideItsRangeIsNamedWithValueUnitAndRange) {
  PlantParameters parameters;
  parameters.solenoid_b.coil.turns = 7;
  try {
    check_ranges(parameters);
    FAIL() << "7 turns were accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("solenoid_b.coil.turns = 7"));
    EXPECT_THAT(error.what(), testing::HasSubstr("100 to 4000"));
  }
  parameters = {};
  parameters.oil.density_15C_kg_per_m3 = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(check_ranges(parameters), std::invalid_argument);
}

TEST(RigParameter, IsDescribedOnceWithUnitReasonAndAnOrderedRange) {
  PlantParameters parameters;
  std::set<std::string> paths;
  for_each_parameter(parameters, [&](std::string_view path, const Parameter& parameter, double&) {
    EXPECT_TRUE(paths.emplace(path).second) << path;
    EXPECT_LT(parameter.min, parameter.max) << path;
    EXPECT_FALSE(parameter.unit.empty()) << path;
    EXPECT_GT(parameter.why.size(), 5U) << path;
  });
  EXPECT_GT(paths.size(), 150U);
}

TEST(RigParameter, VisitorWritesWhatTheAggregateHolds) {
  PlantParameters parameters;
  for_each_parameter(parameters, [](std::string_view path, const Parameter&, double& value) {
    if (path == "edge_PB.overlap_m") value = 3e-4;
  });
  EXPECT_EQ(parameters.edge_PB.overlap_m, 3e-4);
}

}  // namespace
}  // namespace spoolflow::rig
