#include "spoolflow/plausibility/signals/force_delay.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/numerics/meter_lag.hpp"
#include "tests/plausibility/closed_form_coil.hpp"

namespace spoolflow::plausibility {
namespace {

using recording::Channel;
using testing::HasSubstr;
using testing::IsEmpty;

/// Sines of several frequencies at a held position; the force goes with the square of the flux linkage, and the load
/// cell shows it as such a meter does.
recording::Recording shown(const numerics::MeterLag& load_cell, double step_s = 2e-4) {
  recording::Recording out;
  const auto current_A = [](double t) {
    return 1 + 0.3 * std::sin(40 * t) + 0.2 * std::sin(260 * t + std::sin(7 * t));
  };
  const auto flux_at = [&](double t) { return flux_Wb(current_A(t), 1e-3); };
  for (double t = 0; t < 4; t += step_s) {
    const double d = 1e-5;
    out.column(Channel::time).push_back(t);
    out.column(Channel::current).push_back(current_A(t));
    out.column(Channel::voltage).push_back(resistance_Ohm * current_A(t) + (flux_at(t + d) - flux_at(t - d)) / (2 * d));
    out.column(Channel::position).push_back(1e-3);
    out.column(Channel::force).push_back(3000 * flux_at(t) * flux_at(t));
  }
  numerics::apply_lag<double>(out.column(Channel::time), out.column(Channel::force), load_cell);
  return out;
}

TEST(ForceDelay, ALoadCellThatShowsTheForceLateIsNamedByTheCoilsEnergy) {
  EXPECT_THAT(late_force(shown({0.01, 0})), HasSubstr("force comes 10 ms behind the coil's voltage and current"));
  EXPECT_THAT(late_force(shown({0, 0.02})), HasSubstr("and a filter of 20 ms)"));
  EXPECT_THAT(late_force(shown({0.005, 0.004})), HasSubstr("force comes 9 ms behind"));
}

TEST(ForceDelay, IsNoneOfAFastLoadCell) {
  EXPECT_THAT(late_force(shown({})), IsEmpty());
  EXPECT_THAT(late_force(shown({0, 0.0003})), IsEmpty());
}

TEST(ForceDelay, SaysNothingOfSlowSamplesOrWithoutVoltage) {
  EXPECT_THAT(late_force(shown({0.02, 0}, 2e-3)), IsEmpty());
  recording::Recording run = shown({0.02, 0});
  run.column(Channel::voltage).clear();
  EXPECT_THAT(late_force(run), IsEmpty());
}

}  // namespace
}  // namespace spoolflow::plausibility
