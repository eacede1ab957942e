#include "spoolflow/analysis/study.hpp"

#include <gtest/gtest.h>

#include "spoolflow/analysis/study_state.hpp"

namespace spoolflow::analysis {
namespace {

std::vector<double> middle_factors() {
  unsigned numbers = 0;
  for (const Factor& factor : valve_factors()) numbers += factor.numbers;
  return std::vector<double>(numbers, 0.5);
}

TEST(ValveFactors, LeaveTheNominalValveAsItIsInTheMiddleOfTheirSpread) {
  const rig::ValveUnderTest nominal = rig::as_built(rig::valve_preset("fast_dither", rig::Settings()));
  const DrawnValve drawn = drawn_valve(nominal, {}, middle_factors());
  EXPECT_NEAR(drawn.oil_temperature_C, 50, 1e-9);
  std::vector<double> before, after;
  rig::for_each_parameter(nominal.plant, [&](auto, const auto&, const double& v) { before.push_back(v); });
  rig::for_each_parameter(drawn.valve.plant, [&](auto, const auto&, const double& v) { after.push_back(v); });
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t k = 0; k < before.size(); ++k) EXPECT_NEAR(after[k], before[k], 1e-6 * std::abs(before[k]) + 1e-15);
}

TEST(ValveFactors, EachMovesTheValveTheOilOrItsInstruments) {
  const rig::ValveUnderTest nominal;
  std::size_t first = 0;
  for (const Factor& factor : valve_factors()) {
    std::vector<double> uniform = middle_factors();
    for (unsigned k = 0; k < factor.numbers; ++k) uniform[first + k] = 0.9;
    first += factor.numbers;
    const DrawnValve drawn = drawn_valve(nominal, {}, uniform);
    const DrawnValve still = drawn_valve(nominal, {}, middle_factors());
    unsigned moved = drawn.oil_temperature_C != still.oil_temperature_C ? 1 : 0;
    const auto count = [&](const auto& a, const auto& b) {
      std::vector<double> one, other;
      rig::for_each_parameter(a, [&](auto, const auto&, const double& v) { one.push_back(v); });
      rig::for_each_parameter(b, [&](auto, const auto&, const double& v) { other.push_back(v); });
      for (std::size_t k = 0; k < one.size(); ++k) moved += one[k] != other[k] ? 1 : 0;
    };
    count(drawn.valve.plant, still.valve.plant);
    count(drawn.valve.instruments, still.valve.instruments);
    EXPECT_GE(moved, factor.numbers) << factor.name;
  }
}

TEST(StudyState, GivesBackEveryFinishedRunToTheLastBit) {
  FinishedRuns runs(5);
  runs[0] = RunErrors{0.1, 1.0 / 3, 2e-300, 0};
  runs[3] = RunErrors{-0.7, 1e10, 0.2, 0.3};
  const std::string text = study_state(77, runs);
  EXPECT_EQ(finished_runs(text, 77, 5), runs);
  EXPECT_EQ(finished_runs(text, 78, 5), FinishedRuns(5)) << "another study's runs were taken";
  FinishedRuns cut = runs;
  cut[3].reset();
  EXPECT_EQ(finished_runs(text.substr(0, text.size() - 6), 77, 5), cut) << "a damaged line was taken";
}

/// A study that takes a second: the given model saves the calibration.
class InterruptedStudy : public ::testing::Test {
 protected:
  InterruptedStudy() : model(model::read_model(SPOOLFLOW_EXAMPLE_MODEL)) {
    scenario.study.base_samples = 1;
    scenario.study.run_s = 1;
    scenario.study.given_model = true;
  }
  Study finished(const StudyWork& work) { return global_study(model, scenario, study_valve(model, scenario), work); }

  model::Model model;
  Scenario scenario;
};

TEST_F(InterruptedStudy, GoesOnWhereItStoppedAndGivesTheSame) {
  const Study whole = finished({.identity = "1", .workers = 2});
  struct Interrupted {};
  int runs = 0;
  StudyWork work{.identity = "1"};
  std::string saved;
  work.progress = [&](const std::string&, double) {
    if (++runs > 4) throw Interrupted();
  };
  work.saving_interval_s = 0;
  work.save = [&](const std::string& text) { saved = text; };
  EXPECT_THROW(finished(work), Interrupted);
  ASSERT_FALSE(saved.empty());

  runs = 0;
  work.saved = saved;
  work.progress = [&](const std::string&, double) { ++runs; };
  const Study resumed = finished(work);
  EXPECT_EQ(runs, static_cast<int>(whole.runs) - 5) << "finished runs were simulated again";
  for (std::size_t o = 0; o < study_outputs; ++o) {
    EXPECT_EQ(resumed.indices[o].mean, whole.indices[o].mean);
    for (std::size_t f = 0; f < valve_factors().size(); ++f) {
      EXPECT_EQ(resumed.indices[o].factors[f].total.value, whole.indices[o].factors[f].total.value);
      EXPECT_EQ(resumed.indices[o].factors[f].first_order.upper, whole.indices[o].factors[f].first_order.upper);
    }
  }
}

}  // namespace
}  // namespace spoolflow::analysis
