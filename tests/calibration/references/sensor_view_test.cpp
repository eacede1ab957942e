/// What a run through the sensor says of friction.
#include "spoolflow/calibration/references/sensor_view.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "spoolflow/calibration/references/oil_ratios.hpp"
#include "spoolflow/sensor/breakaway_evidence.hpp"

namespace spoolflow::calibration {
namespace {

constexpr double slope_N_per_Pa = 5e-6, highest_Pa = 84e5;

sensor::PressureState<double> pressure_of(double deviation_Pa) {
  sensor::PressureState<double> out;
  out.pressure_difference_Pa = 40e5;
  out.variance_Pa2 = deviation_Pa * deviation_Pa;
  return out;
}

/// The force of a break-away against what is expected of it, by the sensor's own update.
std::optional<double> loss_of(double force_N, double noise_N, double deviation_Pa) {
  const sensor::PressureState<double> prior = pressure_of(deviation_Pa);
  sensor::PressureState<double> posterior = prior;
  sensor::update_breakaway(sensor::PressureParameters<double>{}, posterior, {force_N, slope_N_per_Pa, 0, noise_N}, 0.0,
                           highest_Pa);
  return breakaway_loss(prior, posterior, slope_N_per_Pa);
}

TEST(BreakawayLoss, IsThatOfItsForceHoweverWellThePressureDifferenceIsKnown) {
  for (const double deviation_Pa : {0.5e5, 2e5, 8e5}) {
    const double expected_N = std::hypot(slope_N_per_Pa * deviation_Pa, 1.5);
    for (const double force_N : {-3.0, 0.4, 2.0}) {
      const std::optional<double> loss = loss_of(force_N, 1.5, deviation_Pa);
      ASSERT_TRUE(loss.has_value());
      EXPECT_NEAR(*loss, interval_loss(force_N / expected_N) + std::log(expected_N), 1e-6);
    }
  }
}

TEST(BreakawayLoss, IsNoneWhereTheVarianceDidNotFall) {
  const sensor::PressureState<double> before = pressure_of(2e5), after = pressure_of(2.1e5);
  EXPECT_FALSE(breakaway_loss(before, before, slope_N_per_Pa).has_value());
  EXPECT_FALSE(breakaway_loss(before, after, slope_N_per_Pa).has_value());
}

}  // namespace
}  // namespace spoolflow::calibration
