#include "spoolflow/plausibility/signals/induced_delay.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/plausibility/closed_form_coil.hpp"

namespace spoolflow::plausibility {
namespace {

using recording::Channel;

/// Half a minute of strokes that begin and end within milliseconds, behind a current that changes slowly; the position
/// is recorded so much later than it is.
MotionTrace moved(double late_s, double stroke = 1e-3) {
  std::array<std::vector<double>, recording::channel_count> columns;
  const auto column = [&](Channel channel) -> std::vector<double>& {
    return columns[static_cast<std::size_t>(channel)];
  };
  const auto current_A = [](double t) { return 1.2 + 0.4 * std::sin(4.1 * t); };
  const auto position_m = [&](double t) { return 0.8e-3 + stroke * std::tanh(30 * std::sin(4.1 * t - 0.5)) / 2; };
  const auto flux_at = [&](double t) { return flux_Wb(current_A(t), position_m(t)); };
  for (int k = 0; k < 30'000; ++k) {
    const double t = 1e-3 * k, d = 1e-5;
    column(Channel::time).push_back(t);
    column(Channel::current).push_back(current_A(t));
    column(Channel::position).push_back(position_m(t - late_s));
    column(Channel::voltage).push_back(resistance_Ohm * current_A(t) + (flux_at(t + d) - flux_at(t - d)) / (2 * d));
  }
  MotionTrace out;
  out.take(columns);
  return out;
}

TEST(InducedDelay, AMovingSpoolInducesItsVoltageAtThatInstant) {
  for (const double late_s : {-0.1, -0.02, 0.012, 0.02, 0.1}) {
    const std::optional<double> found_s = induced_delay_s(moved(late_s), coil, 2e-3);
    ASSERT_TRUE(found_s) << late_s;
    EXPECT_NEAR(*found_s, late_s, 0.0021);
  }
}

TEST(InducedDelay, IsNoneOfOneClockNorOfAFewMilliseconds) {
  for (const double late_s : {-0.008, 0.0, 0.006})
    EXPECT_EQ(induced_delay_s(moved(late_s), coil, 2e-3), std::nullopt) << late_s;
}

TEST(InducedDelay, SaysNothingWhereTheSpoolIsSlowOrTheCoilUnknown) {
  EXPECT_EQ(induced_delay_s(moved(0.02, 4e-6), coil, 2e-3), std::nullopt);
  EXPECT_EQ(induced_delay_s(moved(0.02), {}, 2e-3), std::nullopt);
  EXPECT_EQ(induced_delay_s({}, coil, 2e-3), std::nullopt);
}

}  // namespace
}  // namespace spoolflow::plausibility
