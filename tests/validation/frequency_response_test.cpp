#include "spoolflow/validation/frequency_response.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace spoolflow::validation {
namespace {

struct Signals {
  std::vector<double> time_s;
  std::vector<float> reference, estimate;
  [[nodiscard]] FrequencyInput input(double reference_lag_s = 0) const {
    return {time_s, reference, estimate, reference_lag_s};
  }
};

/// First-order lags of white noise, sampled each 2 ms.
Signals noise(double reference_lag_s, double estimate_lag_s, double disturbance = 0) {
  std::mt19937 engine(7);
  std::normal_distribution<double> normal;
  Signals run;
  double reference = 0;
  double estimate = 0;
  constexpr double step_s = 2e-3;
  for (int k = 0; k < 60000; ++k) {
    const double flow = normal(engine);
    const auto follow = [&](double& value, double lag_s) {
      value += lag_s > 0 ? (flow - value) * -std::expm1(-step_s / lag_s) : flow - value;
    };
    follow(reference, reference_lag_s);
    follow(estimate, estimate_lag_s);
    run.time_s.push_back(step_s * k);
    run.reference.push_back(static_cast<float>(reference));
    run.estimate.push_back(static_cast<float>(estimate + disturbance * normal(engine)));
  }
  return run;
}

TEST(FrequencyResponse, OfAFirstOrderLagFalls3dBAtItsCorner) {
  const double corner_Hz = 4;
  const auto response = frequency_response(noise(0, 1 / (2 * std::numbers::pi * corner_Hz)).input());
  ASSERT_TRUE(response);
  ASSERT_TRUE(response->corner_Hz);
  EXPECT_NEAR(*response->corner_Hz, corner_Hz, 0.25);
  EXPECT_NEAR(response->points.front().gain, 1, 0.02);
  for (const FrequencyPoint& point : response->points) {
    if (point.frequency_Hz > 20) break;  // there the sampled lag differs from the continuous one
    const double half_step_s = 1e-3;     // by which the sampled lag is ahead
    EXPECT_NEAR(point.gain, 1 / std::hypot(1, point.frequency_Hz / corner_Hz), 0.03) << point.frequency_Hz;
    EXPECT_NEAR(point.phase_rad,
                -std::atan(point.frequency_Hz / corner_Hz) + 2 * std::numbers::pi * point.frequency_Hz * half_step_s,
                0.04)
        << point.frequency_Hz;
  }
}

TEST(FrequencyResponse, TakesTheMetersLagOut) {
  const double lag_s = 0.03;
  const auto response = frequency_response(noise(lag_s, lag_s).input(lag_s));
  ASSERT_TRUE(response);
  EXPECT_NEAR(*response->corner_Hz, 1 / (2 * std::numbers::pi * lag_s), 0.3);
}

TEST(FrequencyResponse, EndsWhereTheFlowNoLongerExplainsTheEstimate) {
  const auto response = frequency_response(noise(0, 0.05, 0.05).input());
  ASSERT_TRUE(response);
  EXPECT_LT(response->points.back().frequency_Hz, 60);
  EXPECT_GT(response->points.back().frequency_Hz, 5);
}

TEST(FrequencyResponse, WithoutExcitationIsNotStated) {
  Signals run = noise(0, 0.05);
  std::mt19937 engine(8);
  std::normal_distribution<double> normal;
  for (float& estimate : run.estimate) estimate = static_cast<float>(normal(engine));
  EXPECT_FALSE(frequency_response(run.input()));
  run = noise(0, 0.05);
  for (auto* column : {&run.reference, &run.estimate}) std::fill(column->begin(), column->end(), 1.0F);
  EXPECT_FALSE(frequency_response(run.input()));
  EXPECT_FALSE(frequency_response({}));
}

TEST(FrequencyResponse, PassesOverGapsAndMissingValues) {
  Signals run = noise(0, 0.0398);
  for (std::size_t k = 30000; k < run.time_s.size(); ++k) run.time_s[k] += 30;
  for (std::size_t k = 10000; k < 10010; ++k) run.estimate[k] = std::nanf("");
  const auto response = frequency_response(run.input());
  ASSERT_TRUE(response);
  EXPECT_NEAR(*response->corner_Hz, 4, 0.4);
}

}  // namespace
}  // namespace spoolflow::validation
