#include "spoolflow/rig/plant/jiles_atherton.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace spoolflow::rig {
namespace {

constexpr double wall_coercive_A_per_m = 110.0;

struct WallSteel {
  JilesAthertonIron iron = jiles_atherton_iron({}, {}, wall_coercive_A_per_m);
  JilesAthertonMemory memory{};
  double flux_density_T = 0.0;

  double to(double target_T, int steps = 2000) {
    double field_A_per_m = 0;
    const double from_T = flux_density_T;
    for (int i = 1; i <= steps; ++i) {
      flux_density_T = from_T + (target_T - from_T) * i / steps;
      field_A_per_m = magnetise(iron, memory, flux_density_T);
    }
    return field_A_per_m;
  }
};

/// The equations as Jiles and Atherton wrote them, with the field as input, in small explicit steps.
class AsPublished {
 public:
  explicit AsPublished(const JilesAtherton& shape)
      : c_(shape.reversible_share), alpha_(shape.coupling), k_(wall_coercive_A_per_m / (1 - shape.reversible_share)) {}

  /// Flux density after the field has moved there.
  double flux_density_T(double field_A_per_m) {
    const int steps = 10000;
    const double change = (field_A_per_m - field_) / steps;
    for (int i = 0; i < steps; ++i) {
      const double effective = field_ + alpha_ * magnetisation_;
      const double d = 1.0;
      const double reversible_slope = (anhysteretic(effective + d) - anhysteretic(effective - d)) / (2 * d);
      const double lag = anhysteretic(effective) - irreversible_;
      const double irreversible_slope = lag * change > 0 ? std::abs(lag) / k_ : 0;
      const double slope = (1 - c_) * irreversible_slope + c_ * reversible_slope;  // over the effective field
      const double effective_change = change / (1 - alpha_ * slope);
      irreversible_ += irreversible_slope * effective_change;
      magnetisation_ += slope * effective_change;
      field_ += change;
    }
    return vacuum_permeability_H_per_m * (field_ + magnetisation_);
  }

 private:
  /// M_an [A/m] over the effective field, by bisection on the material's curve.
  double anhysteretic(double effective_A_per_m) const {
    double low_T = -6, high_T = 6;
    double magnetisation = 0;
    for (int i = 0; i < 48; ++i) {
      const double middle_T = 0.5 * (low_T + high_T);
      const double field = anhysteretic_field(curve_, middle_T).field_A_per_m;
      magnetisation = middle_T / vacuum_permeability_H_per_m - field;
      (field + alpha_ * magnetisation < effective_A_per_m ? low_T : high_T) = middle_T;
    }
    return magnetisation;
  }

  AnhystereticCurve curve_ = anhysteretic_curve({});
  double c_, alpha_, k_;
  double field_ = 0, magnetisation_ = 0, irreversible_ = 0;
};

TEST(RigJilesAtherton, AgreesWithThePublishedEquations) {
  WallSteel iron;
  AsPublished published({});
  for (const double target_T : {1.2, 0.4, 0.9, -1.0, 0.3}) {
    const double field_A_per_m = iron.to(target_T);
    EXPECT_NEAR(published.flux_density_T(field_A_per_m), target_T, 2e-3) << target_T;
  }
}

TEST(RigJilesAtherton, StepsOfTheIntegratorsLengthAreFineEnough) {
  WallSteel fine, coarse;
  for (const double target_T : {0.8, 0.3, 1.5, 0.9, 1.0, -0.4, 1.2}) {
    // 24 V over the winding move 0.01 T in one period of the electronics; 2 % of the coercive field is left open.
    const int steps = static_cast<int>(std::ceil(std::abs(target_T - coarse.flux_density_T) / 0.01));
    EXPECT_NEAR(coarse.to(target_T, steps), fine.to(target_T, 100 * steps), 2.0) << target_T;
  }
}

TEST(RigJilesAtherton, AfterAReversalTheWallsStandUntilTheCurveHasPassedThem) {
  WallSteel iron;
  iron.to(1.0);
  const double walls_T = iron.memory.irreversible_T;
  iron.to(0.98);
  EXPECT_EQ(iron.memory.irreversible_T, walls_T);
  iron.to(0.5);
  EXPECT_LT(iron.memory.irreversible_T, walls_T);
}

TEST(RigJilesAtherton, SmallLoopsCreepTowardsTheAnhystereticCurve) {
  WallSteel iron;
  iron.to(1.0);
  const double anhysteretic = anhysteretic_field(iron.iron.anhysteretic, 1.0).field_A_per_m;
  const double first = iron.to(1.0) - anhysteretic;
  EXPECT_GT(first, 0.8 * wall_coercive_A_per_m);
  double last = first;
  for (int loop = 0; loop < 30; ++loop) {
    iron.to(0.97, 50);
    const double now = iron.to(1.0, 50) - anhysteretic;
    EXPECT_LE(now, last + 1e-9) << loop;
    last = now;
  }
  EXPECT_LT(last, 0.75 * first);
}

}  // namespace
}  // namespace spoolflow::rig
