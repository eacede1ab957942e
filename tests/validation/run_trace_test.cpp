#include "spoolflow/validation/run_trace.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace spoolflow::validation {
namespace {

/// A flow sine sampled each millisecond, with a spike of the estimate at sample `spike`.
RunSamples sine(std::size_t samples, std::size_t spike = 0) {
  RunSamples run;
  Answers answers{};
  answers.estimator = estimation::Estimator::observer;
  for (std::size_t k = 0; k < samples; ++k) {
    const double t = 1e-3 * static_cast<double>(k);
    const auto flow = static_cast<float>(1e-3 * std::sin(t));
    run.time_s.push_back(t);
    run.position_m.push_back(1e-3);
    run.reference_m3_per_s.push_back(flow);
    answers.flow_m3_per_s.push_back(k == spike ? 1.0F : flow);
    answers.lower_m3_per_s.push_back(flow - 1e-4F);
    answers.upper_m3_per_s.push_back(flow + 1e-4F);
    for (auto* force : {&answers.magnetic_force_N, &answers.spring_force_N, &answers.flow_force_N}) {
      force->push_back(static_cast<float>(k));
    }
    answers.friction_force_N.push_back(-1);
    answers.pressure_difference_Pa.push_back(6e6F);
    answers.status.push_back(k == spike ? sensor::Status::position_fault : sensor::Status::closed);
  }
  run.answers.push_back(std::move(answers));
  return run;
}

std::size_t numbers_in(const TracedChannel& channel) {
  return channel.lowest.size() + channel.highest.size();
}

TEST(RunTrace, HoldsEverySampleWhereThereIsRoom) {
  const RunTrace trace = run_trace(sine(1000, 500), 1'000'000);
  EXPECT_EQ(trace.samples_per_stretch, 1U);
  ASSERT_EQ(trace.time_s.size(), 1000U);
  const TracedEstimator& said = trace.estimators.front();
  EXPECT_TRUE(said.flow_m3_per_s.highest.empty());
  EXPECT_EQ(said.flow_m3_per_s.lowest[500], 1.0F);
  EXPECT_NEAR(said.error_m3_per_s.lowest[499], 0, 1e-9);
  EXPECT_EQ(said.spring_and_flow_N.lowest[10], 20);
  EXPECT_EQ(said.all_forces_N.lowest[10], 19);
  EXPECT_TRUE(trace.pressure_difference_Pa.lowest.empty());
}

TEST(RunTrace, KeepsAPeakOfOneSampleInAMillionWithinItsRoom) {
  const RunTrace trace = run_trace(sine(1'000'000, 654'321), 500'000);
  EXPECT_GT(trace.samples_per_stretch, 1U);
  const TracedEstimator& said = trace.estimators.front();
  EXPECT_EQ(*std::max_element(said.flow_m3_per_s.highest.begin(), said.flow_m3_per_s.highest.end()), 1.0F);
  std::size_t numbers =
      trace.time_s.size() + said.status.size() + said.lower_m3_per_s.size() + said.upper_m3_per_s.size();
  for (const TracedChannel* channel :
       {&trace.reference_m3_per_s, &trace.position_m, &said.flow_m3_per_s, &said.error_m3_per_s,
        &said.pressure_difference_Pa, &said.magnetic_force_N, &said.spring_force_N, &said.flow_force_N,
        &said.friction_force_N, &said.spring_and_flow_N, &said.all_forces_N}) {
    numbers += numbers_in(*channel);
  }
  EXPECT_LE(numbers, 500'000U);
  EXPECT_GT(numbers, 250'000U);
}

TEST(RunTrace, HasWhatTheCoilAndTheOilHadWhereItWasRecorded) {
  RunSamples run = sine(3);
  EXPECT_TRUE(run_trace(run, 1000).voltage_V.lowest.empty());
  run.current_A = {1, 2, 3};
  run.voltage_V = {12, 24, 12};
  run.oil_temperature_K = {323, 323, 324};
  const RunTrace trace = run_trace(run, 1000);
  EXPECT_EQ(trace.current_A.lowest, (std::vector<float>{1, 2, 3}));
  EXPECT_EQ(trace.voltage_V.lowest, (std::vector<float>{12, 24, 12}));
  EXPECT_EQ(trace.oil_temperature_K.lowest[2], 324);
}

TEST(RunTrace, HoldsEveryStatusOfAStretch) {
  const RunTrace trace = run_trace(sine(10'000, 7'000), 10'000);
  const auto place_of = [](sensor::Status bit) {
    for (unsigned n = 0; n < sensor::status_names.size(); ++n) {
      if (sensor::status_names[n].bit == bit) return 1U << n;
    }
    return 0U;
  };
  const std::vector<std::uint32_t>& said = trace.estimators.front().status;
  const unsigned both = place_of(sensor::Status::closed) | place_of(sensor::Status::position_fault);
  EXPECT_EQ(std::count(said.begin(), said.end(), both), 1);
  EXPECT_EQ(std::count(said.begin(), said.end(), place_of(sensor::Status::closed)),
            static_cast<std::ptrdiff_t>(said.size()) - 1);
}

TEST(RunTrace, BreaksWhereNothingWasRecorded) {
  RunSamples run = sine(1000);
  for (std::size_t k = 600; k < 1000; ++k) run.time_s[k] += 1;
  const RunTrace trace = run_trace(run, 1'000'000);
  ASSERT_EQ(trace.time_s.size(), 1001U);
  EXPECT_TRUE(std::isnan(trace.reference_m3_per_s.lowest[600]));
  EXPECT_NEAR(trace.time_s[600], 1.0995, 1e-3);
  EXPECT_TRUE(std::is_sorted(trace.time_s.begin(), trace.time_s.end()));
  EXPECT_TRUE(std::isfinite(trace.reference_m3_per_s.lowest[601]));
}

TEST(RunTrace, OfOneSampleAndOfNone) {
  EXPECT_EQ(run_trace(sine(1), 1000).time_s.size(), 1U);
  EXPECT_TRUE(run_trace(sine(0), 1000).time_s.empty());
}

}  // namespace
}  // namespace spoolflow::validation
