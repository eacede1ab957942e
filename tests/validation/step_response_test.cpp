#include "spoolflow/validation/step_response.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace spoolflow::validation {
namespace {

constexpr double step_scale = 1e-3;

/// A square wave of the flow each two seconds, a millisecond a sample; the meter lags by 20 ms, the estimate is
/// `late_s` late and lags by `lag_s` (all of first order).
RunSamples square_wave(double late_s, double lag_s, double amplitude = 0.3) {
  RunSamples run;
  Answers answers{};
  answers.estimator = estimation::Estimator::observer;
  const auto flow = [&](double t) { return (std::fmod(t, 4.0) < 2 ? 0.2 : 0.2 + amplitude) * step_scale; };
  double meter = flow(0);
  double estimate = flow(0);
  for (int k = 0; k < 16000; ++k) {
    const double t = 1e-3 * k;
    meter += (flow(t) - meter) * -std::expm1(-1e-3 / 0.02);
    estimate += (flow(std::max(0.0, t - late_s)) - estimate) * -std::expm1(-1e-3 / lag_s);
    run.time_s.push_back(t);
    run.reference_m3_per_s.push_back(static_cast<float>(meter));
    answers.flow_m3_per_s.push_back(static_cast<float>(1.1 * estimate));
  }
  run.answers.push_back(std::move(answers));
  return run;
}

TEST(StepResponse, OfAFirstOrderLagRisesIn2Point2TimeConstants) {
  const auto response = step_response(square_wave(0, 0.03), step_scale);
  ASSERT_TRUE(response);
  EXPECT_EQ(response->steps, 7U);
  EXPECT_NEAR(response->reference_rise_s, 2.197 * 0.02, 1e-3);
  const StepAnswer& answer = response->answers.front();
  EXPECT_EQ(answer.followed, 7U);
  EXPECT_NEAR(answer.rise_s, 2.197 * 0.03, 1e-3);
  EXPECT_NEAR(answer.delay_s, std::log(2) * (0.03 - 0.02), 1e-3) << "half is passed after ln 2 time constants";
  EXPECT_NEAR(answer.overshoot, 0, 0.01);
  EXPECT_NEAR(answer.course.front(), 0, 0.01);
  EXPECT_NEAR(answer.course.back(), 1, 0.01);
}

TEST(StepResponse, MeasuresPureDelayAndAnEstimateThatIsAheadOfTheMeter) {
  EXPECT_NEAR(step_response(square_wave(0.05, 0.02), step_scale)->answers.front().delay_s, 0.05, 1e-3);
  EXPECT_LT(step_response(square_wave(0, 0.002), step_scale)->answers.front().delay_s, -0.01);
}

TEST(StepResponse, CountsStepsThatTheEstimateDoesNotFollow) {
  RunSamples run = square_wave(0, 0.03);
  for (float& flow : run.answers.front().flow_m3_per_s) flow = 2e-4F;
  const auto response = step_response(run, step_scale);
  ASSERT_TRUE(response);
  EXPECT_EQ(response->steps, 7U);
  EXPECT_EQ(response->answers.front().followed, 0U);
  EXPECT_TRUE(std::isnan(response->answers.front().delay_s));
}

TEST(StepResponse, NeedsStepsAndAReference) {
  EXPECT_FALSE(step_response(square_wave(0, 0.03, 0.05), step_scale)) << "steps below a tenth of full scale";
  RunSamples ramp = square_wave(0, 0.03);
  for (std::size_t k = 0; k < ramp.time_s.size(); ++k) {
    ramp.reference_m3_per_s[k] = static_cast<float>(step_scale * ramp.time_s[k] / 16);
  }
  EXPECT_FALSE(step_response(ramp, step_scale));
  ramp.reference_m3_per_s.clear();
  EXPECT_FALSE(step_response(ramp, step_scale));
  EXPECT_FALSE(step_response({}, step_scale));
}

}  // namespace
}  // namespace spoolflow::validation
