/// Whole recordings through the sensor: with and without a reference, with gaps, of one sample.
#include "spoolflow/validation/validate.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "tests/sensor/closed_form_valve.hpp"
#include "tests/sensor/linear_valve.hpp"

namespace spoolflow::validation {
namespace {

namespace fs = std::filesystem;

class Validate : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "spoolflow-validate-XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder = name;
    model.valve = {"linear valve", 1e-3, 2.4e-3, "b"};  // full scale 60 L/min
    model.condensed.parameters = sensor::linear_valve();
  }
  void TearDown() override { fs::remove_all(folder); }

  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder / name) << text;
    return folder / name;
  }
  [[nodiscard]] Validation run(const std::vector<fs::path>& recordings, ValidationOptions options = {}) const {
    options.estimators = {estimation::Estimator::condensed};
    return validate(model, recordings, options, [](double) {});
  }
  /// 1.5 A at 1 mm are 20 N of flow force: this flow.
  const double flow_L_min = 60 * std::sqrt(20.0 / 50);

  model::Model model{};
  fs::path folder;
};

std::string number(double value) {
  return std::to_string(value);
}

TEST_F(Validate, AReferenceThatIsOffByAKnownFlowGivesThatError) {
  std::string text = "time_s,current_A,position_mm,flow_reference_L_min,oil_temperature_C\n";
  for (int k = 0; k < 100; ++k) text += number(k * 0.01) + ",1.5,1," + number(flow_L_min - 3) + ",50\n";
  const Validation validation = run({write("run.csv", text)});
  ASSERT_EQ(validation.runs.size(), 1U);
  const RunResult& result = validation.runs.front();
  EXPECT_EQ(result.name, "run");
  EXPECT_EQ(result.samples, 100U);
  EXPECT_NEAR(result.duration_s, 0.99, 1e-9);
  EXPECT_EQ(result.sha256.size(), 64U);
  ASSERT_TRUE(result.results.front().metrics);
  EXPECT_NEAR(result.results.front().metrics->all.error.p95, 3 / 60e3, 1e-8);
  EXPECT_NEAR(result.results.front().metrics->all.error.bias, 3 / 60e3, 1e-8);
  EXPECT_EQ(result.results.front().metrics->moving.error.samples, 0U);
  EXPECT_EQ(result.results.front().metrics->rest.error.samples, 100U);
  EXPECT_NEAR(result.oil_temperature_K->lowest, 323.15, 1e-3);
  EXPECT_FALSE(result.pressure_difference_Pa);
}

TEST_F(Validate, OfAWholeValveIsOverSignedFlow) {
  model.p_to_a = model::Direction{model.condensed, {}, {}};
  model.valve.direction = "both";
  std::string text = "time_s,current_a_A,current_b_A,position_mm,flow_reference_L_min\n";
  for (int k = 0; k < 100; ++k) text += number(k * 0.01) + ",1.5,0,-1," + number(-flow_L_min - 3) + "\n";
  for (int k = 100; k < 200; ++k) text += number(k * 0.01) + ",0,1.5,1," + number(flow_L_min - 3) + "\n";
  ValidationOptions options;
  options.reference_lag_s = 0;
  const RunResult result = run({write("run.csv", text)}, options).runs.front();
  const EstimatorResult& judged = result.results.front();
  EXPECT_NEAR(judged.metrics->all.error.bias, 3 / 60e3, 1e-8) << "both answers lie 3 L/min above the signed reference";
  EXPECT_EQ(judged.metrics->p_to_a.error.samples, 100U);
  EXPECT_EQ(judged.metrics->p_to_b.error.samples, 100U);
  EXPECT_NEAR(result.current_A->lowest, -1.5, 1e-6) << "coil a counts below zero";
  ASSERT_TRUE(judged.sign);
  EXPECT_EQ(judged.sign->samples, 200U);
  EXPECT_EQ(judged.sign->wrong, 0U);
  EXPECT_LT(judged.profiles.front().bins().front().to, 0) << "the flow of P to A has its own bins";
}

TEST_F(Validate, CountsSamplesThatFlowTheOtherWayThanEstimated) {
  model.p_to_a = model::Direction{model.condensed, {}, {}};
  model.valve.direction = "both";
  std::string text = "time_s,current_a_A,current_b_A,position_mm,flow_reference_L_min\n";
  for (int k = 0; k < 100; ++k)
    text += number(k * 0.01) + ",0,1.5,1," + (k < 10 ? "-20" : k < 20 ? "-0.5" : "20") + "\n";
  ValidationOptions options;
  options.reference_lag_s = 0;
  const RunResult result = run({write("run.csv", text)}, options).runs.front();
  options.requirements = Requirements{
      "limits.toml",
      {{.place = "", .figure = Figure::wrong_sign, .unit = LimitUnit::percent, .at_most = 0.0},
       {.place = "", .when = When::p_to_a, .figure = Figure::largest, .at_most = 1e3},
       {.place = "", .run = "each", .figure = Figure::wrong_sign, .unit = LimitUnit::percent, .at_most = 5.0}}};
  const std::vector<JudgedLimit> limits = run({folder / "run.csv"}, options).limits;
  ASSERT_EQ(limits.size(), 3U);
  EXPECT_NEAR(*limits[0].value, 10, 1e-9);
  EXPECT_FALSE(limits[0].met);
  EXPECT_TRUE(limits[1].met) << "the samples measured P to A have figures of their own";
  EXPECT_NEAR(*limits[2].value, 10, 1e-9);
  EXPECT_EQ(result.results.front().sign->wrong, 10U) << "0.5 L/min have no direction to be sure of";
}

TEST_F(Validate, PoolsTheRunsThatHaveAReference) {
  const std::string head = "time_s,current_A,position_mm,flow_reference_L_min\n";
  const fs::path first = write("a.csv", head + "0,1.5,1," + number(flow_L_min - 1) + "\n");
  const fs::path second = write("b.csv", head + "0,1.5,1," + number(flow_L_min + 2) + "\n");
  const fs::path without = write("c.csv", "time_s,current_A,position_mm\n0,1.5,1\n");
  const Validation validation = run({first, second, without});
  ASSERT_EQ(validation.runs.size(), 3U);
  EXPECT_FALSE(validation.runs.back().has_reference);
  EXPECT_FALSE(validation.runs.back().results.front().metrics);
  ASSERT_TRUE(validation.pooled.front().metrics);
  EXPECT_EQ(validation.pooled.front().metrics->all.error.samples, 2U);
  EXPECT_NEAR(validation.pooled.front().metrics->all.error.largest, 2 / 60e3, 1e-8);
}

TEST_F(Validate, CountsEveryRunAlikeHoweverLongItIs) {
  const auto text_of = [&](int samples, double less_L_min) {
    std::string text = "time_s,current_A,position_mm,flow_reference_L_min\n";
    for (int k = 0; k < samples; ++k) text += number(k * 0.01) + ",1.5,1," + number(flow_L_min - less_L_min) + "\n";
    return text;
  };
  const Validation validation = run({write("long.csv", text_of(980, 1)), write("short.csv", text_of(20, 5))});
  const PooledResult& pooled = validation.pooled.front();
  EXPECT_NEAR(pooled.by_sample->all.error.p95 * 60e3, 1, 1e-3) << "the short run's are 2 % of the samples";
  EXPECT_NEAR(pooled.metrics->all.error.p95 * 60e3, 5, 1e-3) << "and half of the runs";
  EXPECT_NEAR(pooled.metrics->all.error.bias * 60e3, 3, 1e-3);
  EXPECT_NEAR(pooled.metrics->all.error.rms * 60e3, std::sqrt(13), 1e-3);
  EXPECT_EQ(pooled.metrics->all.error.samples, 1000U);
}

TEST_F(Validate, TakesMotionFromTheSpoolWhateverWasCommanded) {
  std::string text = "time_s,current_A,position_mm,position_set_percent,flow_reference_L_min\n";
  for (int k = 0; k < 2000; ++k) {  // the command stands; the spool steps by 1 mm in 20 ms, and the meter errs then
    const double gone = std::clamp((k - 1000) / 20.0, 0.0, 1.0);
    text += number(k * 1e-3) + ",1.5," + number(0.8 + gone) + ",41.7," +
            number(k == 1010 ? -40.0 : 60 * std::sqrt(20.0 / 50)) + "\n";
  }
  const WorstMoment worst = *run({write("step.csv", text)}).runs.front().results.front().worst;
  EXPECT_NEAR(worst.time_s, 1.010, 1e-9);
  EXPECT_TRUE(worst.moving);
  EXPECT_GT(worst.velocity_m_per_s, 0.01);
}

TEST_F(Validate, StatesTheReferencesScaleAndZeroAndAppliesNeither) {
  std::string text = "time_s,current_A,position_mm,flow_reference_L_min\n";
  for (int k = 0; k < 4000; ++k) {
    const double current_A = 1.5 + 0.5 * std::sin(0.01 * k), flow = 60 * std::sqrt((current_A * 20 - 10) / 50);
    text +=
        number(k * 0.01) + "," + number(current_A) + ",1," + number(1.1 * flow + 2 + 0.2 * std::sin(0.37 * k)) + "\n";
  }
  const RunResult result = run({write("run.csv", text)}).runs.front();
  ASSERT_TRUE(result.reference_scale);
  EXPECT_NEAR(result.reference_scale->scale, 1.1, 4 * result.reference_scale->scale_uncertainty + 1e-3);
  EXPECT_NEAR(result.reference_scale->offset_m3_per_s * 60e3, 2, 0.1);
  EXPECT_LT(result.reference_scale->scale_uncertainty, 0.01);
  EXPECT_LT(result.results.front().metrics->all.error.bias * 60e3, -4) << "raw, as compared";
}

TEST_F(Validate, SkipsSamplesWhoseReferenceIsMissingAndStillEstimatesThem) {
  const std::string text = "time_s,current_A,position_mm,flow_reference_L_min\n0,1.5,1," + number(flow_L_min) +
                           "\n0.01,1.5,1,\n0.02,1.5,1," + number(flow_L_min) + "\n";
  const RunResult result = run({write("gaps.csv", text)}).runs.front();
  EXPECT_EQ(result.samples, 3U);
  EXPECT_EQ(result.results.front().metrics->all.error.samples, 2U);
  EXPECT_EQ(result.results.front().flow_m3_per_s.time_s.size(), 3U);
}

TEST_F(Validate, StatesTheWorstMoment) {
  std::string text = "time_s,current_A,position_mm,position_set_percent,flow_reference_L_min\n";
  for (int k = 0; k < 1000; ++k) {
    text += number(k * 0.01) + ",1.5,1,41.7," + number(flow_L_min - (k == 700 ? 20 : 1)) + "\n";
  }
  const RunResult result = run({write("run.csv", text)}).runs.front();
  ASSERT_TRUE(result.results.front().worst);
  const WorstMoment& worst = *result.results.front().worst;
  EXPECT_NEAR(worst.time_s, 7, 1e-9);
  EXPECT_NEAR(worst.error_m3_per_s, 20 / 60e3, 1e-8);
  EXPECT_TRUE(worst.rest);
  EXPECT_NEAR(worst.reference_m3_per_s.time_s.front(), 5.5, 0.011);
  EXPECT_NEAR(worst.reference_m3_per_s.time_s.back(), 8.5, 0.011);
}

TEST_F(Validate, AppliesTheMetersLagToTheEstimateOnRequest) {
  // The current steps at 1 s; the meter follows with 0.1 s. The lagged estimate agrees with it, the plain one does not.
  std::string text = "time_s,current_A,position_mm,flow_reference_L_min\n";
  double meter_L_min = 60 * std::sqrt(10.0 / 50);
  for (int k = 0; k < 3000; ++k) {
    const double flow = 60 * std::sqrt((k < 1000 ? 10.0 : 30.0) / 50);
    meter_L_min += (1 - std::exp(-1e-3 / 0.1)) * (flow - meter_L_min);
    text += number(k * 1e-3) + (k < 1000 ? ",1.0,1," : ",2.0,1,") + number(meter_L_min) + "\n";
  }
  const fs::path file = write("step.csv", text);
  const auto largest = [&](bool apply) {
    const Validation validation =
        run({file}, {.estimators = {}, .channels = {}, .reference_lag_s = 0.1, .apply_reference_lag = apply});
    return validation.runs.front().results.front().metrics->all.error.largest * 60e3;
  };
  EXPECT_GT(largest(false), 15);
  EXPECT_LT(largest(true), 0.01);
}

/// What a meter with a lag of 0.05 s shows of strokes between two flows; `own_L_min`: what the flow itself is off by,
/// to and fro, which the sensor does not see.
std::string strokes(double own_L_min) {
  std::string text = "time_s,current_A,position_mm,flow_reference_L_min\n";
  double meter_L_min = 60 * std::sqrt(10.0 / 50);
  for (int k = 0; k < 20000; ++k) {
    const bool high = k / 1000 % 2 == 1;
    const double flow = 60 * std::sqrt((high ? 30.0 : 10.0) / 50) + ((k / 150) % 2 == 0 ? own_L_min : -own_L_min);
    meter_L_min += (1 - std::exp(-1e-3 / 0.05)) * (flow - meter_L_min);
    text += number(k * 1e-3) + (high ? ",2.0,1," : ",1.0,1,") + number(meter_L_min) + "\n";
  }
  return text;
}

TEST_F(Validate, ARunThatDoesNotShowItsMetersLagTakesThatOfTheOtherRuns) {
  const fs::path clear = write("clear.csv", strokes(0)), unclear = write("unclear.csv", strokes(3));
  const RunResult alone = run({unclear}).runs.front();
  EXPECT_EQ(alone.reference_meter.source, MeterSource::none);
  EXPECT_EQ(alone.reference_meter.meter.lag_s, 0);
  for (const std::vector<fs::path>& order : {std::vector{clear, unclear}, std::vector{unclear, clear}}) {
    const Validation both = run(order);
    const std::size_t k = order.front() == unclear ? 0 : 1;
    const RunResult& beside = both.runs[k];
    EXPECT_EQ(beside.name, "unclear");
    EXPECT_EQ(both.runs[1 - k].reference_meter.source, MeterSource::this_run);
    EXPECT_EQ(beside.reference_meter.source, MeterSource::other_runs);
    EXPECT_NEAR(beside.reference_meter.meter.lag_s, 0.05, 0.002);
    EXPECT_EQ(both.reference_lag_s, beside.reference_meter.meter.lag_s);
    const auto rms = [](const RunResult& of) { return of.results.front().metrics->all.error.rms; };
    EXPECT_LT(rms(beside), 0.8 * rms(alone));
    EXPECT_GT(rms(beside), rms(both.runs[1 - k]));
  }
}

TEST_F(Validate, FindsTheMetersLagBesideEdgeAndPressureDifferenceWhereTheSensorSeesNoChange) {
  model.observer = model::Observer{sensor::closed_form_observer<double>(sensor::closed_form), {}, {}, {}, {}};
  const double lag_s = 0.05;
  double meter = sensor::closed_form.flow_m3_per_s(1e-3, 20e5, 313);
  std::string head = "time_s,current_A,position_mm,oil_temperature_C,flow_reference_L_min", plain, pressed;
  for (int k = 0; k < 20000; ++k) {
    const double pressure_Pa = k / 1000 % 2 == 0 ? 20e5 : 50e5;  // under a spool and a current that stand
    meter += -std::expm1(-1e-3 / lag_s) * (sensor::closed_form.flow_m3_per_s(1e-3, pressure_Pa, 313) - meter);
    const std::string row = number(k * 1e-3) + ",1.5,1,39.85," + number(60e3 * meter);
    plain += row + "\n";
    pressed += row + "," + number(1e-5 * pressure_Pa) + "\n";
  }
  EXPECT_EQ(run({write("plain.csv", head + "\n" + plain)}).runs.front().reference_meter.source, MeterSource::none);
  const RunResult result = run({write("pressed.csv", head + ",pressure_difference_bar\n" + pressed)}).runs.front();
  EXPECT_EQ(result.reference_meter.source, MeterSource::this_run);
  EXPECT_NEAR(result.reference_meter.meter.lag_s, lag_s, 0.003);
  EXPECT_NEAR(result.reference_meter.meter.dead_time_s, 0, 0.003);
}

TEST_F(Validate, SaysThatARunWasAlreadyUsedForTheCalibration) {
  const fs::path file = write("run.csv", "time_s,current_A,position_mm,flow_reference_L_min\n0,1.5,1,30\n");
  EXPECT_FALSE(run({file}).runs.front().calibrated_with);
  model.provenance.inputs.push_back({"operation", "run.csv", model::sha256_of_file(file), 1});
  EXPECT_TRUE(run({file}).runs.front().calibrated_with);
}

}  // namespace
}  // namespace spoolflow::validation
