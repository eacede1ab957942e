/// The plant's own integrator against SUNDIALS CVODE at a relative tolerance of 1e-8.
#include "tests/cvode/plant_cvode.hpp"

#include <gtest/gtest.h>

#include "tests/rig/plant/smooth_plant.hpp"

namespace spoolflow::rig::reference {
namespace {

/// Drives both over `duration_s` and compares once a period of the electronics.
TrajectoryError distance_from_cvode(const PlantParameters& p, double duration_s) {
  PlantInput input = smooth_drive(0);
  PlantState state = plant_at_rest(p, input);
  PlantCvode cvode(p, state, 1e-8);
  TrajectoryError error;
  double lowest_m = 0, highest_m = 0;
  for (int tick = 0; tick * electronics_period_s < duration_s; ++tick) {
    input = smooth_drive(tick * electronics_period_s);
    step(p, state, input, electronics_period_s);
    cvode.advance(input, electronics_period_s);
    error.compare(observe(p, state, input), observe(p, cvode.state(), input));
    lowest_m = std::min(lowest_m, state.position_m);
    highest_m = std::max(highest_m, state.position_m);
  }
  EXPECT_GT(highest_m - lowest_m, 0.5 * full_stroke_m) << "the drive does not move the spool";
  return error;
}

void expect_within_a_ten_thousandth(const TrajectoryError& error) {
  EXPECT_LT(error.position, 1e-4);
  EXPECT_LT(error.force, 1e-4);
  EXPECT_LT(error.flow, 1e-4);
}

TEST(PlantAgainstCvode, AgreesWhereTheBenchHoldsThePressureDifference) {
  expect_within_a_ten_thousandth(distance_from_cvode(smooth_plant(), 0.15));
}

TEST(PlantAgainstCvode, AgreesThroughAnOrifice) {
  PlantParameters p = smooth_plant();
  p.load.kind = LoadKind::orifice;
  expect_within_a_ten_thousandth(distance_from_cvode(p, 0.15));
}

TEST(PlantAgainstCvode, AgreesWithACylinderAndItsMass) {
  PlantParameters p = smooth_plant();
  p.load.kind = LoadKind::cylinder;
  expect_within_a_ten_thousandth(distance_from_cvode(p, 0.15));
}

TEST(PlantAgainstCvode, AgreesWithAMotorWhoseReturnGoesToTank) {
  PlantParameters p = smooth_plant();
  p.load.kind = LoadKind::motor;
  p.load.return_to_tank = true;
  expect_within_a_ten_thousandth(distance_from_cvode(p, 0.15));
}

TEST(PlantAgainstCvode, AgreesWhereTheBenchJoinsThePortsOrFeedsTheReturn) {
  for (const LoadKind kind : {LoadKind::held_path, LoadKind::held_return}) {
    PlantParameters p = smooth_plant();
    p.load.kind = kind;
    expect_within_a_ten_thousandth(distance_from_cvode(p, 0.15));
  }
}

}  // namespace
}  // namespace spoolflow::rig::reference
