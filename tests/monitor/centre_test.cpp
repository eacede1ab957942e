/// Where a whole valve rests in its centre, and what that shows of its position sensor.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/monitor/monitor.hpp"
#include "tests/monitor/example.hpp"

namespace spoolflow::monitor {
namespace {

/// Both directions alike.
model::Model whole() {
  model::Model out = example();
  out.p_to_a = {.condensed = out.condensed, .observer = out.observer, .evidence = out.evidence};
  return out;
}

/// Strokes to b and a by turns, each back to the centre with both coils silent. Friction leaves the spool short of it.
struct Strokes {
  double zero_m = 0;
  double short_m = 0;  ///< of the centre, on the side from which it comes
  int count = 20;
  bool to_b_alone = false;
};

void take(Monitor& watch, const model::Model& model, const Strokes& strokes) {
  double time_s = 0;
  const double drift_free_K = model.observer->parameters.position_sensor.drift_free_K;
  for (int stroke = 0; stroke < strokes.count; ++stroke) {
    const double side = strokes.to_b_alone || stroke % 2 == 0 ? 1 : -1;
    for (int k = 0; k < 1000; ++k) {
      const bool driven = k < 300;
      const double position_m = side * (driven ? 0.5e-3 : strokes.short_m) + strokes.zero_m;
      const estimation::TimedSample sample{.time_s = time_s += 1e-3,
                                           .current_A = driven && side > 0 ? 0.8 : 0,
                                           .voltage_V = estimation::not_measured,
                                           .position_m = position_m,
                                           .oil_temperature_K = drift_free_K,
                                           .current_a_A = driven && side < 0 ? 0.8 : 0};
      sensor::Estimate<double> answer{};
      answer.status = sensor::Status::spool_at_rest;
      watch.take(sample, answer);
    }
  }
  watch.finish();
}

Monitor watched(const model::Model& model, const Strokes& strokes) {
  Monitor watch(model);
  take(watch, model, strokes);
  return watch;
}

Indicator centre(const Monitor& watch) {
  for (const Indicator& each : watch.indicators()) {
    if (each.name == "centre_position") return each;
  }
  throw std::out_of_range("there is no centre_position");
}

TEST(Centre, ASensorWhoseZeroDriftedIsRaisedAsThat) {
  const model::Model model = whole();
  for (const double drift_m : {40e-6, -40e-6, 100e-6}) {
    const Monitor watch = watched(model, {.zero_m = drift_m});
    EXPECT_NEAR(centre(watch).value, drift_m, 1e-6);
    EXPECT_LT(centre(watch).uncertainty_95, 10e-6);
    EXPECT_EQ(centre(watch).state, IndicatorState::raised);
    ASSERT_FALSE(watch.causes().empty());
    EXPECT_EQ(watch.causes().front().fault, Fault::position_sensor);
    EXPECT_EQ(watch.causes().size(), 1U);
    EXPECT_EQ(watch.condition(), Ne107::out_of_specification);
  }
}

TEST(Centre, AHealthyOneRaisesNothing) {
  const model::Model model = whole();
  for (const double drift_m : {0.0, 7e-6, -7e-6}) {
    const Monitor watch = watched(model, {.zero_m = drift_m, .count = 200});
    EXPECT_EQ(centre(watch).state, IndicatorState::good);
    EXPECT_EQ(watch.condition(), Ne107::good);
    EXPECT_TRUE(watch.causes().empty());
  }
}

// It holds the spool short of the centre on either side.
TEST(Centre, FrictionIsNoShiftedZero) {
  const model::Model model = whole();
  const Monitor watch = watched(model, {.short_m = 50e-6, .count = 200});
  EXPECT_NEAR(centre(watch).value, 0, 1e-6);
  EXPECT_EQ(watch.condition(), Ne107::good);
}

TEST(Centre, StrokesToOneSideAloneDoNotShowIt) {
  const model::Model model = whole();
  const Monitor watch = watched(model, {.zero_m = 40e-6, .to_b_alone = true});
  EXPECT_EQ(centre(watch).state, IndicatorState::unknown);
  EXPECT_EQ(watch.condition(), Ne107::good);
}

TEST(Centre, ABaselineTakesTheZeroThatTheValveHadThen) {
  const model::Model model = whole();
  const Baseline then = watched(model, {.zero_m = 20e-6}).learnt();
  Monitor later(model, {}, then);
  take(later, model, {.zero_m = 20e-6, .count = 200});
  EXPECT_NEAR(centre(later).baseline, 15e-6, 3e-6);  // healthy valves have none: it is pulled to that
  EXPECT_EQ(later.condition(), Ne107::good);
}

TEST(Centre, AValveOfOneDirectionHasItsClosedStopInstead) {
  EXPECT_THROW((void)centre(Monitor(example())), std::out_of_range);
}

}  // namespace
}  // namespace spoolflow::monitor
