/// Axial-force maps of a bench in closed form: what it measures at the ends of its strokes.
#include "spoolflow/calibration/fits/axial_force.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace spoolflow::calibration {
namespace {

using recording::Channel;
constexpr double bench_stroke_m = 2.4e-3;
constexpr double dry_friction_N = 6;

/// Springs and flow force [N].
double spool_force_N(double position_m, double pressure_difference_Pa) {
  return 9 + 12e3 * position_m + 2.5e-3 * position_m * pressure_difference_Pa;
}

/// Opened and closed in 20 s at each pressure difference, with a second of rest at either end, sampled at 100 Hz.
/// Friction turns over along a straight line; what it has grown by at rest, `breakaway_N`, wears off over 15 um of
/// sliding.
recording::Recording bench(double breakaway_N) {
  constexpr double slope_m = 5e-6, wear_m = 15e-6;
  recording::Recording out;
  double time_s = 0;
  const auto put = [&](double position_m, double way, double travelled_m, double pressure_difference_Pa) {
    const double sliding = std::min(1.0, 2 * travelled_m / slope_m - 1);
    const double worn = travelled_m < slope_m ? 0 : std::exp(-(travelled_m - slope_m) / wear_m);
    const double friction = way * (dry_friction_N * sliding + breakaway_N * worn);
    out.column(Channel::time).push_back(time_s += 0.01);
    out.column(Channel::position).push_back(position_m);
    out.column(Channel::pressure_difference).push_back(pressure_difference_Pa);
    out.column(Channel::pressure_difference_set).push_back(pressure_difference_Pa);
    out.column(Channel::axial_force).push_back(spool_force_N(position_m, pressure_difference_Pa) + friction);
    out.column(Channel::flow).push_back(1e-4 * position_m * std::sqrt(pressure_difference_Pa));
    out.column(Channel::oil_temperature).push_back(323);
  };
  for (const double pressure_difference_Pa : {10e5, 40e5, 70e5}) {
    for (const double way : {1.0, -1.0}) {
      const double from_m = way > 0 ? 0 : bench_stroke_m;
      for (int k = 0; k <= 1000; ++k)
        put(from_m + way * bench_stroke_m * k / 1000, way, bench_stroke_m * k / 1000, pressure_difference_Pa);
      for (int k = 0; k < 100; ++k) put(bench_stroke_m - from_m, way, bench_stroke_m, pressure_difference_Pa);
    }
  }
  return out;
}

TEST(AxialForce, OfASpoolThatBreaksAwayAfterItsRestsIsThatOfOneThatSlides) {
  const AxialForceFit fit = fit_axial_force(bench(8), bench_stroke_m);
  ASSERT_EQ(fit.loops.size(), 3U);
  for (const model::AxialForceLoop& loop : fit.loops) {
    for (std::size_t k = 0; k < loop.position_m.size(); ++k) {
      const double mean_N = 0.5 * (loop.opening_N[k] + loop.closing_N[k]);
      EXPECT_NEAR(mean_N, spool_force_N(loop.position_m[k], loop.pressure_difference_set_Pa), 0.15)
          << loop.position_m[k];
      EXPECT_NEAR(0.5 * (loop.opening_N[k] - loop.closing_N[k]), dry_friction_N, 0.15) << loop.position_m[k];
    }
  }
}

}  // namespace
}  // namespace spoolflow::calibration
