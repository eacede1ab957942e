#include "spoolflow/monitor/monitor.hpp"

#include <cmath>
#include <cstring>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/estimation/estimator.hpp"
#include "spoolflow/estimation/recordings/sensor_channels.hpp"
#include "spoolflow/monitor/baseline.hpp"
#include "spoolflow/monitor/indicators.hpp"
#include "tests/monitor/example.hpp"

namespace spoolflow::monitor {
namespace {

struct Answered {
  std::vector<estimation::TimedSample> samples;
  std::vector<sensor::Estimate<double>> answers;
};

Answered run_of(const std::string& name) {
  Answered out;
  const auto reader = estimation::open_sensor_channels(std::string(SPOOLFLOW_EXAMPLES) + "/" + name,
                                                       estimation::sensor_channels(example(), {}));
  estimation::RunningSensor sensor = estimation::running_sensor(example(), estimation::Estimator::observer);
  recording::SampleBlock block;
  while (reader->next(block)) {
    const estimation::Columns columns = estimation::sensor_columns(block);
    for (std::size_t k = 0; k < columns.size(); ++k) {
      out.samples.push_back(columns[k]);
      out.answers.push_back(sensor.step(columns[k]));
    }
  }
  return out;
}

const Answered& ramp() {
  static const Answered run = run_of("ramp_60bar.h5");
  return run;
}

const Indicator& named(const std::vector<Indicator>& indicators, std::string_view name) {
  for (const Indicator& each : indicators) {
    if (each.name == name) return each;
  }
  throw std::out_of_range("no such indicator");
}

TEST(Monitor, AHealthyValveRaisesNothing) {
  for (const char* name : {"ramp_60bar.h5", "duty_cycle_1.h5"}) {
    const Answered run = run_of(name);
    Monitor watch(example());
    watch.take(run.samples, run.answers);
    watch.finish();
    EXPECT_EQ(watch.condition(), Ne107::good) << name;
    EXPECT_TRUE(watch.causes().empty()) << name;
  }
}

TEST(Monitor, NeverTakesATemperatureThatNoOilHas) {
  Answered run = ramp();
  run.samples.front().oil_temperature_K = 1.6e32;
  Monitor watch(example());
  watch.take(run.samples, run.answers);
  EXPECT_NEAR(watch.state().oil_temperature_K, run.samples.back().oil_temperature_K, 1);
  EXPECT_TRUE(Monitor(example()).set_state(watch.state()));
}

TEST(Monitor, CountsTowardsAnAlarmOnTheSideOfTheFaultAlone) {
  const std::vector<Indicator> indicators = Monitor(example()).indicators();
  const AlarmLimits friction = alarm_limits(named(indicators, "friction_ratio"));
  EXPECT_NEAR(friction.above, 1.12, 1e-9);
  EXPECT_TRUE(std::isnan(friction.below));  // less friction is no fault
  const AlarmLimits preload = alarm_limits(named(indicators, "spring_preload_ratio"));
  EXPECT_LT(preload.below, 1);
  EXPECT_TRUE(std::isnan(preload.above));
  const AlarmLimits zero = alarm_limits(named(indicators, "position_zero"));
  EXPECT_EQ(zero.below, -zero.above);
  const Indicator& coil = named(indicators, "coil_resistance");
  EXPECT_NEAR(alarm_limits(coil).above / coil.baseline, 1.393, 1e-3);  // copper, 100 K warmer
  EXPECT_TRUE(std::isnan(alarm_limits(named(indicators, "strokes")).above));
}

TEST(Monitor, CountsWhatTheValveDid) {
  Monitor watch(example());
  watch.take(ramp().samples, ramp().answers);
  watch.finish();
  const auto indicators = watch.indicators();
  EXPECT_NEAR(named(indicators, "watched_time").value, 47, 0.1);
  EXPECT_GE(named(indicators, "distance").value, 2 * 2.3e-3);
  EXPECT_NEAR(named(indicators, "friction_ratio").value, 1, 0.15);
  EXPECT_NEAR(named(indicators, "closed_position").value, 0, 10e-6);
  EXPECT_NEAR(named(indicators, "coil_resistance").value, 2.97, 0.05);
}

// The same forces, 1.6 times as much friction: what the net force differs from the flow force by grows.
TEST(Monitor, MoreFrictionIsRaisedAsFriction) {
  Answered run = ramp();
  for (sensor::Estimate<double>& answer : run.answers) {
    const double apparent_N = answer.magnetic_force_N - answer.spring_force_N - answer.flow_force_N;
    answer.magnetic_force_N += 0.6 * apparent_N;
  }
  Monitor watch(example());
  for (int k = 0; k < 4; ++k) {
    watch.take(run.samples, run.answers);
    watch.finish();
  }
  ASSERT_FALSE(watch.causes().empty());
  EXPECT_EQ(watch.causes().front().fault, Fault::friction);
  EXPECT_EQ(watch.condition(), Ne107::maintenance_required);
  EXPECT_EQ(named(watch.indicators(), "friction_ratio").state, IndicatorState::raised);
}

TEST(Monitor, WhatItFoundIsPutRightInTheModelAndNoLongerThere) {
  Answered run = ramp();
  for (sensor::Estimate<double>& answer : run.answers) {
    const double apparent_N = answer.magnetic_force_N - answer.spring_force_N - answer.flow_force_N;
    answer.magnetic_force_N += 0.6 * apparent_N;
  }
  const auto watched = [&](const model::Model& model) {
    Monitor watch(model);
    for (int k = 0; k < 4; ++k) {
      watch.take(run.samples, run.answers);
      watch.finish();
    }
    return watch.findings();
  };
  const Findings found = watched(example());
  ASSERT_TRUE(found.side[0].raised);
  const model::Model corrected = adapted(example(), found, {});
  EXPECT_NEAR(corrected.provenance.adaptations.back().corrections.front().value, 1.6, 0.25);
  EXPECT_FALSE(watched(corrected).side[0].raised);
}

TEST(Monitor, PassesOverAVoltageThatIsOnNoCoil) {
  Answered run = ramp();
  Monitor without(example()), with(example());
  without.take(run.samples, run.answers);
  for (const double voltage_V : {2e3, -1e38})
    run.samples[run.samples.size() / (voltage_V > 0 ? 2 : 3)].voltage_V = voltage_V;
  with.take(run.samples, run.answers);
  const Indicator expected = named(without.indicators(), "coil_resistance");
  EXPECT_NEAR(named(with.indicators(), "coil_resistance").value, expected.value, 0.1 * expected.uncertainty_95);
  Monitor again(example());
  EXPECT_TRUE(again.set_state(with.state()));
}

TEST(Monitor, MeasuresHowTheSpoolFollowsItsCommand) {
  Monitor watch(example());
  for (std::size_t k = 0; k < 3000; ++k) {
    estimation::TimedSample sample = ramp().samples[k];
    sample.position_m = k > 1010 ? 0.4e-3 : 0;
    watch.take(sample, ramp().answers[k], k > 1000 ? 0.4e-3 : 0);
  }
  EXPECT_NEAR(named(watch.indicators(), "response_time").value, 0.01, 0.002);
  EXPECT_NEAR(named(watch.indicators(), "overshoot").value, 0, 1e-6);
}

TEST(Doubt, WidensTheBandByWhatTheFaultMakesOfTheFlow) {
  const std::size_t middle = ramp().samples.size() / 2;
  const estimation::TimedSample& sample = ramp().samples[middle];
  const sensor::Estimate<double>& answer = ramp().answers[middle];
  const sensor::Estimate<double> same = widened(example(), {}, sample, 323, answer);
  EXPECT_EQ(same.flow_upper_m3_per_s, answer.flow_upper_m3_per_s);
  EXPECT_EQ(same.status, answer.status);
  double last = answer.flow_upper_m3_per_s - answer.flow_lower_m3_per_s;
  for (const double size : {0.5, 1.0, 2.0}) {
    Doubt doubt;
    doubt.side[0] = {true, {0, 0, 0, 0, size, 0}};
    const sensor::Estimate<double> wider = widened(example(), doubt, sample, 323, answer);
    EXPECT_EQ(wider.flow_m3_per_s, answer.flow_m3_per_s);
    EXPECT_TRUE(sensor::has(wider.status, sensor::Status::model_doubt));
    EXPECT_GT(wider.flow_upper_m3_per_s - wider.flow_lower_m3_per_s, last);
    last = wider.flow_upper_m3_per_s - wider.flow_lower_m3_per_s;
  }
}

TEST(Monitor, GoesOnFromItsBytes) {
  Monitor whole(example());
  whole.take(ramp().samples, ramp().answers);
  Monitor first(example());
  const std::size_t half = ramp().samples.size() / 2;
  first.take(std::span(ramp().samples).first(half), std::span(ramp().answers).first(half));
  std::vector<std::byte> bytes(sizeof(MonitorState));
  std::memcpy(bytes.data(), &first.state(), bytes.size());
  MonitorState kept;
  std::memcpy(&kept, bytes.data(), bytes.size());
  Monitor second(example());
  ASSERT_TRUE(second.set_state(kept));
  second.take(std::span(ramp().samples).subspan(half), std::span(ramp().answers).subspan(half));
  const auto expected = whole.indicators();
  const auto found = second.indicators();
  for (std::size_t k = 0; k < expected.size(); ++k) {
    if (!std::isfinite(expected[k].value)) continue;
    EXPECT_EQ(found[k].value, expected[k].value) << expected[k].name;
  }
  kept.version = 0;
  EXPECT_FALSE(second.set_state(kept));
}

TEST(Monitor, RubbishChangesStatusAndNothingElse) {
  Monitor watch(example());
  estimation::RunningSensor sensor = estimation::running_sensor(example(), estimation::Estimator::observer);
  std::mt19937_64 generator(5);
  const double rubbish[] = {estimation::not_measured, std::numeric_limits<double>::infinity(), -1e300, 1e300, 0, 1e-3};
  const auto any = [&] { return rubbish[generator() % std::size(rubbish)]; };
  for (int k = 0; k < 20000; ++k) {
    const estimation::TimedSample sample{k % 3 == 0 ? any() : 1e-3 * k, any(), any(), any(), any()};
    watch.take(sample, sensor.step(sample));
  }
  watch.finish();
  for (const Indicator& each : watch.indicators()) EXPECT_NE(each.state, IndicatorState::raised) << each.name;
  for (const Cause& cause : watch.causes()) EXPECT_NE(cause.fault, Fault::friction);
}

TEST(Monitor, AsManyAnswersAsSamples) {
  Monitor watch(example());
  EXPECT_THROW(watch.take(std::span(ramp().samples).first(3), std::span(ramp().answers).first(2)),
               std::invalid_argument);
}

TEST(Baseline, ReadsBackAsItWasWritten) {
  Monitor watch(example());
  watch.take(ramp().samples, ramp().answers);
  watch.finish();
  const Baseline written = watch.learnt();
  const Baseline read = parse_baseline("{\"baseline\": " + baseline_text(written) + "}", "base.json");
  EXPECT_EQ(read.model, written.model);
  EXPECT_EQ(read.side[0].centre, written.side[0].centre);
  EXPECT_EQ(read.side[0].spread, written.side[0].spread);
  Monitor later(example(), {}, read);
  later.take(ramp().samples, ramp().answers);
  later.finish();
  EXPECT_EQ(later.condition(), Ne107::good);
}

TEST(Baseline, OfAnotherModelIsRefused) {
  Baseline other{fingerprint(example()) + 1, {}};
  EXPECT_THROW(Monitor(example(), {}, other), model::ModelError);
}

TEST(Baseline, DamagedOnesNameThePlace) {
  using testing::HasSubstr;
  const auto message = [](const std::string& text) {
    try {
      static_cast<void>(parse_baseline(text, "base.json"));
    } catch (const model::ModelError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(message("no json"), HasSubstr("base.json"));
  EXPECT_THAT(message("{}"), HasSubstr("/baseline"));
  EXPECT_THAT(message(R"({"baseline": {"model": "xyz"}})"), HasSubstr("xyz"));
  EXPECT_THAT(message(R"({"baseline": {"model": "12", "b": {"windows": -1}}})"), HasSubstr("/baseline/b/windows"));
}

}  // namespace
}  // namespace spoolflow::monitor
