#include "spoolflow/calibration/fits/sliding_friction.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "spoolflow/calibration/numerics/calibration_error.hpp"

namespace spoolflow::calibration {
namespace {

constexpr double step_s = 1e-3;
constexpr FrictionLaw slide{.mass_kg = 0.2,
                            .viscous_opening_N_s_per_m = 15,
                            .viscous_closing_N_s_per_m = 25,
                            .coulomb_opening_N = 3,
                            .coulomb_closing_N = 4};

struct Measured {
  std::vector<double> position_m, force_N;

  [[nodiscard]] SlidingFrictionFit fit(FrictionSymmetry symmetry, FrictionMotion motion) const {
    const std::array whole{Sweep{Direction::opening, 0, position_m.size()}};
    return fit_sliding_friction(
        {.position_m = position_m, .force_N = force_N, .time_step_s = step_s, .bandwidth_Hz = 100, .stretches = whole},
        symmetry, motion);
  }
};

/// Two sines whose speeds differ, so that inertia, viscous and dry friction stand apart.
Measured measured(const FrictionLaw& law, double force_noise_N) {
  Measured out;
  std::mt19937 generator(11);
  std::normal_distribution<double> noise(0, force_noise_N);
  for (int k = 0; k < 20'000; ++k) {
    const double t = k * step_s;
    const double slow = 2 * std::numbers::pi * 0.5, fast = 2 * std::numbers::pi * 3;
    out.position_m.push_back(0.05 * std::sin(slow * t) + 0.01 * std::sin(fast * t));
    const double v = 0.05 * slow * std::cos(slow * t) + 0.01 * fast * std::cos(fast * t);
    const double a = -0.05 * slow * slow * std::sin(slow * t) - 0.01 * fast * fast * std::sin(fast * t);
    const double friction_N = v > 0 ? law.viscous_opening_N_s_per_m * v + law.coulomb_opening_N
                                    : law.viscous_closing_N_s_per_m * v - law.coulomb_closing_N;
    out.force_N.push_back(law.mass_kg * a + friction_N + law.offset_N + noise(generator));
  }
  return out;
}

void expect_within(const SlidingFrictionFit& fit, const FrictionLaw& truth, double FrictionLaw::*member) {
  EXPECT_NEAR(fit.law.*member, truth.*member, 4 * fit.uncertainty.*member + 0.005 * std::abs(truth.*member));
}

TEST(SlidingFriction, IsFoundForEachDirectionWithinItsUncertainty) {
  Measured data = measured(slide, 0.5);
  for (std::size_t k = 4'000; k < 4'005; ++k) data.position_m[k] = data.force_N[k + 700] = std::nan("");
  const SlidingFrictionFit fit = data.fit(FrictionSymmetry::by_direction, FrictionMotion::accelerated);
  expect_within(fit, slide, &FrictionLaw::mass_kg);
  expect_within(fit, slide, &FrictionLaw::viscous_opening_N_s_per_m);
  expect_within(fit, slide, &FrictionLaw::viscous_closing_N_s_per_m);
  expect_within(fit, slide, &FrictionLaw::coulomb_opening_N);
  expect_within(fit, slide, &FrictionLaw::coulomb_closing_N);
  EXPECT_LT(fit.uncertainty.coulomb_opening_N, 0.1);
}

TEST(SlidingFriction, IsSeparatedFromAnOffsetWhereBothDirectionsShareIt) {
  FrictionLaw law = slide;
  law.viscous_closing_N_s_per_m = law.viscous_opening_N_s_per_m;
  law.coulomb_closing_N = law.coulomb_opening_N;
  law.offset_N = -1.5;
  const SlidingFrictionFit fit = measured(law, 0.5).fit(FrictionSymmetry::same_both_ways, FrictionMotion::accelerated);
  expect_within(fit, law, &FrictionLaw::offset_N);
  expect_within(fit, law, &FrictionLaw::coulomb_closing_N);
}

TEST(SlidingFriction, RefusesMotionOneWay) {
  Measured data;
  for (int k = 0; k < 2'000; ++k) {
    data.position_m.push_back(1e-6 * k);
    data.force_N.push_back(3);
  }
  EXPECT_THROW((void)data.fit(FrictionSymmetry::by_direction, FrictionMotion::even_strokes), CalibrationError);
}

}  // namespace
}  // namespace spoolflow::calibration
