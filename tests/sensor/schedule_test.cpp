/// The schedule of the step: what runs seldom accounts for all of the time, and no sample does everything.
#include <gtest/gtest.h>

#include "spoolflow/sensor/observer.hpp"

namespace spoolflow::sensor {
namespace {

/// Calls `each` with the schedule of every sample of a spool at rest.
template <class Each>
void scheduled(double step_s, double duration_s, const Each& each) {
  const PositionSensor<double> lvdt{.noise_m = 1e-6, .hardest_acceleration_m_per_s2 = 90};
  PositionState<double> state{};
  begin(state, 1e-3);
  for (int k = 0; k * step_s < duration_s; ++k) {
    const PositionPoint<double> point = track(lvdt, state, Sample<double>{step_s, 1, 10, 1e-3, 313}, {}, 0.0,
                                              Dither<double>{}, false, [] { return 0.0; });
    each(detail::schedule_of(point.block));
  }
}

class ScheduleAt : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(SampledEvery, ScheduleAt, testing::Values(50e-6, 200e-6, 1e-3, 2e-3, 5e-3),
                         [](const auto& rate) { return std::to_string(static_cast<int>(1e6 * rate.param)) + "us"; });

TEST_P(ScheduleAt, AccountsForAllOfTheTimeInWhatRunsSeldom) {
  constexpr double duration_s = 2;
  double memory_s = 0, ratio_s = 0, oil_s = 0;
  int uncertainty = 0, band = 0;
  scheduled(GetParam(), duration_s, [&](const Schedule<double>& now) {
    memory_s += now.friction_memory.now ? now.friction_memory.since_s() : 0;
    ratio_s += now.friction_ratio.now ? now.friction_ratio.since_s() : 0;
    oil_s += now.oil_temperature.now ? now.oil_temperature.since_s() : 0;
    uncertainty += now.force_uncertainty ? 1 : 0;
    band += now.band ? 1 : 0;
  });
  for (const double passed_s : {memory_s, ratio_s, oil_s}) EXPECT_NEAR(passed_s, duration_s, 0.01);
  EXPECT_GT(uncertainty * GetParam(), 0.2 * duration_s);
  EXPECT_GT(band * GetParam(), 0.2 * duration_s);
}

TEST_P(ScheduleAt, LetsNoSampleDoEverythingWhereABlockIsSeveral) {
  if (GetParam() > 1e-3) GTEST_SKIP() << "a block is one sample";
  int samples = 0;
  scheduled(GetParam(), 0.1, [&](const Schedule<double>& now) {
    if (++samples * GetParam() < 3e-3) return;  // until the first block closes all run
    EXPECT_FALSE(now.friction_memory.now && (now.coil_diagnosis.now || now.force_uncertainty || now.band));
    EXPECT_FALSE(now.force_uncertainty && now.band);
    EXPECT_FALSE(now.friction_ratio.now && now.oil_temperature.now);
    EXPECT_EQ(now.force_uncertainty, now.slip_excess);
  });
}

}  // namespace
}  // namespace spoolflow::sensor
