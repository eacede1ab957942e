/// The flow of metering edges at a measured pressure difference, against closed form.
#include "spoolflow/estimation/edge_flow.hpp"

#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/sensor/closed_form_valve.hpp"

namespace spoolflow::estimation {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double free_K = sensor::ClosedFormValve::drift_free_K;  // the position sensor reads right

TEST(EdgeFlow, IsThatOfOrificeLawAtEachOpeningAndPressureDifference) {
  const auto valve = sensor::closed_form_observer<double>(sensor::closed_form);
  const std::array position_m{0.1e-3, 0.8e-3, 1.6e-3, 1.6e-3}, pressure_Pa{30e5, 30e5, 60e5, -60e5};
  const std::vector<double> flow =
      edge_flow({&valve}, position_m, pressure_Pa, std::array{free_K, free_K, free_K, free_K});
  for (std::size_t k = 0; k < flow.size(); ++k) {
    const double expected = sensor::closed_form.flow_m3_per_s(position_m[k], std::abs(pressure_Pa[k]), free_K);
    EXPECT_NEAR(flow[k], expected, 1e-3 * sensor::closed_form.full_scale_m3_per_s()) << k;
  }
}

TEST(EdgeFlow, OfAWholeValveGoesTheOtherWayThroughTheOtherEdge) {
  const sensor::ClosedFormValve wider{.scale = 1.5};
  const auto b = sensor::closed_form_observer<double>(sensor::closed_form);
  const auto a = sensor::closed_form_observer<double>(wider);
  const std::vector<double> flow =
      edge_flow({&b, &a}, std::array{1e-3, -1e-3}, std::array{40e5, 40e5}, std::array{free_K, free_K});
  EXPECT_GT(flow[0], 0);
  EXPECT_NEAR(flow[1] / flow[0], -1.5, 1e-6);
}

TEST(EdgeFlow, IsUnknownWherePositionOrPressureIsAndTakesTheOilAsItWas) {
  const auto valve = sensor::closed_form_observer<double>(sensor::closed_form);
  const std::vector<double> flow =
      edge_flow({&valve}, std::array{1e-3, unknown, 1e-3, 1e-3}, std::array{40e5, 40e5, unknown, 40e5},
                std::array{free_K, free_K, free_K, unknown});
  EXPECT_TRUE(std::isnan(flow[1]));
  EXPECT_TRUE(std::isnan(flow[2]));
  EXPECT_EQ(flow[3], flow[0]);
}

}  // namespace
}  // namespace spoolflow::estimation
