#include "spoolflow/calibration/flow_bench/conductance_fit.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace spoolflow::calibration {
namespace {

using recording::Channel;

constexpr double metered_stroke_m = 2.4e-3, meter_lag_s = 0.04;

double conductance(double x) {
  return 2e-7 * std::pow(std::fmax(0.0, x / metered_stroke_m - 0.15), 1.5);
}

/// A spool that hops by 0.12 mm and rests between, as it does under friction, beside a meter with a lag.
recording::Recording hopping() {
  constexpr double sampling_s = 2e-3;
  recording::Recording out;
  out.file = "metering.csv";
  double shown = 0;
  const auto put = [&](double x, double pressure_Pa) {
    shown += (1 - std::exp(-sampling_s / meter_lag_s)) * (conductance(x) * std::sqrt(pressure_Pa) - shown);
    out.column(Channel::time).push_back(static_cast<double>(out.size()) * sampling_s);
    out.column(Channel::position).push_back(x);
    out.column(Channel::pressure_difference).push_back(pressure_Pa);
    out.column(Channel::flow_reference).push_back(shown);
    out.column(Channel::oil_temperature).push_back(313.15);
  };
  for (const double pressure_Pa : {1e6, 3e6, 6e6}) {
    for (int k = 0; k < 300; ++k) put(0, pressure_Pa);
    for (int hop = 0; hop <= 40; ++hop) {
      const double x =
          metered_stroke_m * (hop <= 20 ? hop : 40 - hop) / 20 + (hop == 20 || hop == 0 || hop == 40 ? 0 : 9e-6);
      for (int k = 0; k < 120; ++k) put(x, pressure_Pa);
    }
  }
  return out;
}

TEST(ConductanceFit, SeesThroughTheMetersLagWhereTheSpoolHops) {
  const ConductanceFit fit = fit_conductance(hopping(), metered_stroke_m);
  ASSERT_EQ(fit.levels.size(), 3U);
  EXPECT_NEAR(fit.meter_lag_s, meter_lag_s, 0.003);
  EXPECT_NEAR(fit.oil_temperature_K, 313.15, 1e-6);
  for (const ConductanceLevel& level : fit.levels) {
    for (int k = 8; k < conductance_positions; ++k) {
      const double x = metered_stroke_m * k / (conductance_positions - 1);
      EXPECT_NEAR(level.conductance_m3_per_s_per_rootPa[static_cast<std::size_t>(k)], conductance(x),
                  0.01 * conductance(metered_stroke_m));
    }
    EXPECT_NEAR(level.conductance_m3_per_s_per_rootPa.front(), 0, 1e-9);
  }
}

TEST(ConductanceFit, OfAForceRigIsItsFlowOverTheRootOfThePressure) {
  AxialForceFit rig{};
  model::AxialForceLoop& loop = rig.loops.emplace_back();
  for (int k = 0; k < 97; ++k) {
    loop.pressure_difference_Pa.push_back(2e6 - 1e3 * k);  // a supply that gives way
    loop.flow_m3_per_s.push_back(conductance(metered_stroke_m * k / 96) * std::sqrt(2e6 - 1e3 * k));
  }
  const ConductanceFit fit = conductance_of(rig);
  ASSERT_EQ(fit.levels.size(), 1U);
  EXPECT_NEAR(fit.levels[0].pressure_difference_Pa, 2e6 - 48e3, 1);
  for (const int k : {0, 20, 48})
    EXPECT_NEAR(fit.levels[0].conductance_m3_per_s_per_rootPa[static_cast<std::size_t>(k)],
                conductance(metered_stroke_m * k / (conductance_positions - 1)), 1e-13);
}

}  // namespace
}  // namespace spoolflow::calibration
