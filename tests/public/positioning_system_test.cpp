/// Friction identification on the electro-mechanical positioning system EMPS: Janot, Gautier, Brunot, Data set and
/// reference models of EMPS, Workshop on Nonlinear System Identification Benchmarks (2019).
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "public_data.hpp"
#include "spoolflow/calibration/fits/sliding_friction.hpp"

namespace spoolflow::calibration {
namespace {

struct PositioningSystem : public_data::PublicData {
  PositioningSystem() : PublicData("emps") {}

  SlidingFrictionFit fit(FrictionSymmetry symmetry) const {
    constexpr double force_per_voltage_N_per_V = 35.1507;
    auto read = public_data::columns(data / "DATA_EMPS.mat", {"qm", "vir"});
    for (double& force : read[1]) force *= force_per_voltage_N_per_V;
    // To and fro without strokes of the bench kind: the whole recording is judged.
    const std::array whole{Sweep{Direction::opening, 0, read[0].size()}};
    return fit_sliding_friction(
        {.position_m = read[0], .force_N = read[1], .time_step_s = 1e-3, .bandwidth_Hz = 100, .stretches = whole},
        symmetry, FrictionMotion::accelerated);
  }
};

void expect_share(const char* what, double found, double published, double share) {
  fmt::print("  {:<32} {:9.4f}, published {:9.4f}: {:+.2f} %\n", what, found, published, 100 * (found / published - 1));
  EXPECT_NEAR(found, published, share * std::abs(published)) << what;
}

TEST_F(PositioningSystem, HasThePublishedMassAndFriction) {
  const SlidingFrictionFit both = fit(FrictionSymmetry::same_both_ways);
  expect_share("mass [kg]", both.law.mass_kg, 95.1089, 0.01);
  expect_share("viscous friction [N s/m]", both.law.viscous_opening_N_s_per_m, 203.5034, 0.01);
  expect_share("Coulomb friction [N]", both.law.coulomb_opening_N, 20.3935, 0.01);
  expect_share("offset [N]", both.law.offset_N, -3.1648, 0.02);
  expect_share("residual, share of the force [%]", 100 * both.residual.rms() / both.force_rms_N, 4.0834, 0.05);
}

TEST_F(PositioningSystem, HasThePublishedAsymmetryOfFriction) {
  const SlidingFrictionFit each = fit(FrictionSymmetry::by_direction);
  expect_share("mass [kg]", each.law.mass_kg, 95.1540, 0.01);
  expect_share("viscous friction opening [N s/m]", each.law.viscous_opening_N_s_per_m, 166.7061, 0.01);
  expect_share("viscous friction closing [N s/m]", each.law.viscous_closing_N_s_per_m, 240.4236, 0.01);
  expect_share("Coulomb friction opening [N]", each.law.coulomb_opening_N, 20.1440, 0.01);
  expect_share("Coulomb friction closing [N]", each.law.coulomb_closing_N, 20.6277, 0.01);
  expect_share("residual, share of the force [%]", 100 * each.residual.rms() / each.force_rms_N, 3.1117, 0.05);
  const double difference = each.law.viscous_closing_N_s_per_m - each.law.viscous_opening_N_s_per_m;
  EXPECT_GT(difference,
            5 * std::hypot(each.uncertainty.viscous_closing_N_s_per_m, each.uncertainty.viscous_opening_N_s_per_m));
}

}  // namespace
}  // namespace spoolflow::calibration
