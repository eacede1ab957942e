#include "spoolflow/monitor/healthy_spread.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "spoolflow/estimation/estimator.hpp"
#include "spoolflow/estimation/recordings/sensor_channels.hpp"
#include "spoolflow/monitor/correction.hpp"
#include "spoolflow/monitor/monitor.hpp"
#include "tests/monitor/example.hpp"

namespace spoolflow::monitor {
namespace {

constexpr std::size_t of_friction = index(Magnitude::friction);

/// A valve with other friction, beside which valve A has so many times as much.
model::Model beside(double friction_ratio) {
  model::Model out = example();
  apply({.friction_ratio = 1 / friction_ratio}, out.valve.stroke_m, out.observer->parameters);
  return out;
}

/// The same as the model of a type, `spread` one standard deviation of the friction between units, as a share.
model::Model type_beside(double friction_ratio, double spread) {
  model::Model out = beside(friction_ratio);
  sensor::Environment<double>& own = out.observer->parameters.environment;
  out.type = model::TypeSection{"NG6", false, {{"spring_preload", "1", 0.03, 0, 0.03}}, {1}, {}};
  out.type->environment = {own.force_N, own.friction_share, own.flow_share, 0};
  own.friction_share = std::hypot(own.friction_share, spread);
  return out;
}

/// Valve A's slow strokes, several times over, as `model` sees them.
Monitor watched(const model::Model& model, const std::optional<Baseline>& baseline = {}) {
  Monitor out(model, {}, baseline);
  for (int k = 0; k < 3; ++k) {
    const auto reader =
        estimation::open_sensor_channels(SPOOLFLOW_EXAMPLES "/ramp_60bar.h5", estimation::sensor_channels(model, {}));
    estimation::RunningSensor sensor = estimation::running_sensor(model, estimation::Estimator::observer);
    recording::SampleBlock block;
    while (reader->next(block)) {
      const estimation::Columns columns = estimation::sensor_columns(block);
      for (std::size_t row = 0; row < columns.size(); ++row) out.take(columns[row], sensor.step(columns[row]));
    }
    out.finish();
  }
  return out;
}

TEST(HealthySpread, AUnitWithinItsTypesSpreadIsHealthyByTheTypesModelAndNotByAnotherValves) {
  constexpr double ratio = 1.5;
  const model::Model other = beside(ratio), type = type_beside(ratio, 0.3);
  EXPECT_EQ(watched(other).condition(), Ne107::maintenance_required);
  const Monitor unit = watched(type);
  EXPECT_EQ(unit.condition(), Ne107::good);
  EXPECT_TRUE(unit.causes().empty());
}

TEST(HealthySpread, FrictionFarBeyondTheTypesSpreadIsRaised) {
  const model::Model type = type_beside(2.6, 0.3);
  const Monitor worn = watched(type);
  ASSERT_FALSE(worn.causes().empty());
  EXPECT_EQ(worn.causes().front().fault, Fault::friction);
  EXPECT_EQ(worn.condition(), Ne107::maintenance_required);
}

TEST(HealthySpread, ABaselineOfTheUnitTakesThePlaceOfTheTypes) {
  constexpr double ratio = 1.5;
  const model::Model type = type_beside(ratio, 0.3);
  const Baseline learnt = watched(type).learnt();
  EXPECT_NEAR(1 + learnt.side[0].centre[of_friction] * usual_fault[of_friction], ratio, 0.2);
  EXPECT_LT(learnt.side[0].spread[of_friction], healthy_spread[of_friction]);
  EXPECT_EQ(watched(type, learnt).condition(), Ne107::good);
}

TEST(HealthySpread, IsThatOfOneValveWhereTheModelIsAndGrowsWithWhatIsNotKnownOfAUnit) {
  constexpr std::size_t preload = index(Magnitude::preload_loss);
  EXPECT_EQ(healthy_spread_of(example()), healthy_spread);
  const model::Model model = type_beside(1, 0.3);
  const Magnitudes type = healthy_spread_of(model);
  EXPECT_NEAR(type[of_friction], std::hypot(healthy_spread[of_friction], 0.3 / usual_fault[of_friction]), 1e-9);
  EXPECT_GE(type[preload] * usual_fault[preload], 0.03);  // of the mean force; the closed spool's is smaller
  EXPECT_EQ(type[index(Magnitude::rate_loss)], healthy_spread[index(Magnitude::rate_loss)]);
  model::Model unit = model;
  unit.type->deviations[0].uncertainty = 0.01;
  EXPECT_LT(healthy_spread_of(unit)[preload], type[preload]);
}

}  // namespace
}  // namespace spoolflow::monitor
