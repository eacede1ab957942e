#include "spoolflow/rig/hydraulics/oil.hpp"

#include <utility>

#include <gtest/gtest.h>

namespace spoolflow::rig {
namespace {

TEST(RigOil, Hlp46FollowsItsViscosityOverTemperature) {
  // 75, 46, 21, 11 mm2/s at 30, 40, 60, 80 C (docs of the project's physics; computed after Walther), to their
  // rounding.
  for (const auto& [temperature_C, viscosity] : {std::pair{30.0, 75e-6}, {40.0, 46e-6}, {60.0, 21e-6}, {80.0, 11e-6}}) {
    EXPECT_NEAR(oil_at(Oil{}, temperature_C).viscosity_m2_per_s / viscosity, 1.0, 0.03) << temperature_C;
  }
  EXPECT_NEAR(oil_at(Oil{}, 40.0).viscosity_m2_per_s, 46e-6, 1e-12);
  EXPECT_NEAR(oil_at(Oil{}, 100.0).viscosity_m2_per_s, 6.8e-6, 1e-12);
}

TEST(RigOil, LosesAboutThreeAndAHalfPercentOfItsDensityOverFiftyKelvin) {
  const double ratio = oil_at(Oil{}, 80.0).density_kg_per_m3 / oil_at(Oil{}, 30.0).density_kg_per_m3;
  EXPECT_NEAR(ratio, 0.9646, 1e-3);
}

TEST(RigOil, EntrainedAirSoftensItNearAmbientPressureOnly) {
  const Oil oil;
  const OilState state = oil_at(oil, 50.0);
  Oil pure = oil;
  pure.entrained_air = 0.0;
  EXPECT_GT(compressibility_per_Pa(oil, state, 0.0), 10.0 * compressibility_per_Pa(pure, state, 0.0));
  EXPECT_LT(compressibility_per_Pa(oil, state, 100e5), 1.02 * compressibility_per_Pa(pure, state, 100e5));
}

TEST(RigOil, StaysFiniteInTheColdWhateverItsViscosityIndex) {
  const Oil thick{.viscosity_40C_m2_per_s = 200e-6, .viscosity_100C_m2_per_s = 2e-6};
  EXPECT_NEAR(oil_at(thick, -40.0).viscosity_m2_per_s, stiffest_oil_m2_per_s, 1e-9);
}

}  // namespace
}  // namespace spoolflow::rig
