/// What holds for iron of either kind: it is passive, has no negative susceptibility, and forgets by a shrinking field.
#include "spoolflow/rig/plant/magnetic_hysteresis.hpp"

#include <cmath>
#include <random>
#include <type_traits>

#include <gtest/gtest.h>

namespace spoolflow::rig {
namespace {

static_assert(std::is_trivially_copyable_v<IronMemory>);

/// Iron driven through flux densities.
struct DrivenIron {
  Iron iron;
  IronMemory memory{};
  double work_J_per_m3 = 0.0;

  explicit DrivenIron(const MagneticHysteresis& hysteresis) : iron(iron_of({}, hysteresis)) {}

  void drive_to(double target_T, int steps = 400) {
    const double from_T = memory.flux_density_T;
    for (int i = 1; i <= steps; ++i) {
      work_J_per_m3 += magnetise(iron, memory, i == steps ? target_T : from_T + (target_T - from_T) * i / steps);
    }
  }
  double field_after(double target_T) {
    drive_to(target_T);
    return memory.field_A_per_m;
  }
  void cycle(double peak_T) {
    drive_to(-peak_T);
    drive_to(peak_T);
  }
};

class EitherIron : public testing::TestWithParam<HysteresisKind> {
 protected:
  static MagneticHysteresis of(double coercive_field_A_per_m) {
    return {.kind = GetParam(), .coercive_field_A_per_m = coercive_field_A_per_m};
  }
};

TEST_P(EitherIron, EveryLoopCostsEnergyAndALargerOneMore) {
  double smaller = 0.0;
  for (const double peak_T : {0.01, 0.03, 0.1, 0.3, 0.6, 1.0, 1.5, 1.9, 2.3}) {
    DrivenIron iron(of(110));
    for (int cycle = 0; cycle < 4; ++cycle) iron.cycle(peak_T);
    iron.work_J_per_m3 = 0;
    iron.cycle(peak_T);
    EXPECT_GT(iron.work_J_per_m3, smaller) << peak_T;
    EXPECT_LT(iron.work_J_per_m3, 4.4 * 110 * peak_T) << "wider than two coercive fields, " << peak_T;
    smaller = iron.work_J_per_m3;
  }
}

TEST_P(EitherIron, CoerciveFieldIsHalfTheWidthOfTheLargeLoop) {
  for (const double coercive : {30.0, 110.0, 250.0}) {
    DrivenIron iron(of(coercive));
    iron.drive_to(1.9);
    // The relays' mean is met where as many have switched back as not: the curve bends, so a tenth is left open.
    EXPECT_NEAR(iron.field_after(0.0), -coercive, 0.12 * coercive);
  }
}

TEST_P(EitherIron, GivesBackNoMoreThanWasPutIn) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> level(-1.0, 1.0);
  for (int run = 0; run < 40; ++run) {
    DrivenIron iron(of(run % 2 == 0 ? 110 : 500));
    const double reach_T = 0.05 * std::pow(1.1, run);
    for (int turn = 0; turn < 60; ++turn) {
      iron.drive_to(reach_T * level(random), 60);
      EXPECT_GT(iron.work_J_per_m3, -1e-3) << "run " << run << ", turn " << turn;
    }
  }
}

TEST_P(EitherIron, TheFieldRisesWithTheFluxDensityThroughStepsOfAnySize) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> exponent(-9.0, 0.6), sign(-1.0, 1.0);
  for (int run = 0; run < 20; ++run) {
    DrivenIron iron(of(run % 2 == 0 ? 110 : 600));
    for (int step = 0; step < 2000; ++step) {
      const IronMemory before = iron.memory;
      const double change_T =
          std::copysign(std::pow(10.0, exponent(random)), sign(random) - 0.2 * before.flux_density_T);
      const FieldPoint point = iron_field(iron.iron, before, before.flux_density_T + change_T);
      ASSERT_TRUE(std::isfinite(point.field_A_per_m));
      ASSERT_GT(point.slope_m_per_H, 0.0);
      ASSERT_LE(point.slope_m_per_H, 1.0001 / vacuum_permeability_H_per_m);
      // Rounding of the flux density: 1e-12 T in air.
      ASSERT_GE((point.field_A_per_m - before.field_A_per_m) * std::copysign(1.0, change_T),
                -2e-6 * (1 + std::abs(before.flux_density_T)));
      magnetise(iron.iron, iron.memory, before.flux_density_T + change_T);
      ASSERT_EQ(iron.memory.field_A_per_m, point.field_A_per_m);
    }
  }
}

TEST_P(EitherIron, SlopeBelongsToTheField) {
  DrivenIron iron(of(110));
  for (const double target_T : {0.9, 0.2, 0.7, -1.2, 1.7}) {
    iron.drive_to(target_T);
    for (const double change_T : {-0.3, -0.05, 0.04, 0.2}) {
      const double d = 1e-6, at_T = target_T + change_T;
      const double difference = iron_field(iron.iron, iron.memory, at_T + d).field_A_per_m -
                                iron_field(iron.iron, iron.memory, at_T - d).field_A_per_m;
      const double slope = iron_field(iron.iron, iron.memory, at_T).slope_m_per_H;
      EXPECT_NEAR(difference / (2 * d) / slope, 1.0, 1e-3) << target_T << " and " << change_T;
    }
  }
}

TEST_P(EitherIron, AShrinkingFieldDemagnetises) {
  DrivenIron iron(of(110));
  EXPECT_LT(iron.field_after(0.0), 1e-9);
  iron.drive_to(1.8);
  EXPECT_LT(iron.field_after(0.0), -90);
  for (double peak_T = 1.9; peak_T > 1e-3; peak_T *= 0.95) iron.cycle(peak_T);
  EXPECT_NEAR(iron.field_after(0.0), 0.0, 0.03 * 110);
}

TEST_P(EitherIron, BothSignsAreAlike) {
  DrivenIron one(of(110)), other(of(110));
  for (const double target_T : {1.2, 0.3, 0.8, -1.5, 0.1, 2.1}) {
    EXPECT_NEAR(one.field_after(target_T), -other.field_after(-target_T), 1e-6) << target_T;
  }
}

TEST_P(EitherIron, WithoutCoerciveFieldThereIsNoMemory) {
  DrivenIron travelled(of(0));
  for (const double target_T : {1.6, -1.9, 0.4, 0.9}) travelled.drive_to(target_T);
  DrivenIron direct(of(0));
  EXPECT_NEAR(travelled.field_after(0.5), direct.field_after(0.5), 0.03);
  travelled.work_J_per_m3 = 0;
  travelled.drive_to(1.5);
  travelled.drive_to(0.5);
  EXPECT_NEAR(travelled.work_J_per_m3, 0.0, 0.1);  // of some 600 J/m3 on one way
}

TEST_P(EitherIron, SaturatesIntoAir) {
  DrivenIron iron(of(110));
  iron.drive_to(4.0);
  EXPECT_NEAR(iron_field(iron.iron, iron.memory, 4.1).slope_m_per_H * vacuum_permeability_H_per_m, 1.0, 1e-2);
}

INSTANTIATE_TEST_SUITE_P(Kinds, EitherIron, testing::Values(HysteresisKind::jiles_atherton, HysteresisKind::preisach),
                         [](const auto& which) {
                           return which.param == HysteresisKind::preisach ? "Preisach" : "JilesAtherton";
                         });

TEST(RigMagneticMaterial, RunsFromItsPermeabilityIntoThatOfAir) {
  const AnhystereticCurve curve = anhysteretic_curve({});
  EXPECT_NEAR(anhysteretic_field(curve, 4.0).slope_m_per_H * vacuum_permeability_H_per_m, 1.0, 1e-2);
  EXPECT_LT(anhysteretic_field(curve, 0.0).slope_m_per_H * vacuum_permeability_H_per_m, 2e-3);
  for (double flux = -2.5; flux < 2.5; flux += 0.05) {  // the slope belongs to the field
    const double d = 1e-5;
    const double difference =
        anhysteretic_field(curve, flux + d).field_A_per_m - anhysteretic_field(curve, flux - d).field_A_per_m;
    EXPECT_NEAR(difference / (2 * d) / anhysteretic_field(curve, flux).slope_m_per_H, 1.0, 1e-4) << flux;
  }
}

}  // namespace
}  // namespace spoolflow::rig
