/// The budget of the sensor calibrated on the example recordings, at points and along a run.
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/analysis/point_analysis.hpp"
#include "spoolflow/analysis/run_analysis.hpp"
#include "spoolflow/analysis/run_function.hpp"
#include "spoolflow/recording/channels/recording_error.hpp"

namespace spoolflow::analysis {
namespace {

using estimation::Estimator;
using uncertainty::InputErrors;
using uncertainty::InputQuantity;
using uncertainty::PointFunction;
using uncertainty::SeededNumbers;

const model::Model& example() {
  static const model::Model model = model::read_model(SPOOLFLOW_EXAMPLE_MODEL);
  return model;
}

/// Near the middle of the stroke, between the grid points of every table.
uncertainty::WorkingPoint middle() {
  return {0.513 * example().valve.stroke_m, 40e5, uncertainty::map_temperature_K(example())};
}

const uncertainty::BudgetLine& line(const uncertainty::Budget& budget, InputQuantity quantity) {
  for (const uncertainty::BudgetLine& each : budget.lines) {
    if (each.input.quantity == quantity) return each;
  }
  throw std::out_of_range(std::string(uncertainty::about(quantity).name));
}

TEST(BudgetAtAPoint, DerivativesThroughTheTemplatesAreThoseOfSmallDifferences) {
  const PointFunction function = *PointFunction::at(example(), Estimator::condensed, middle());
  const uncertainty::Budget budget = function.budget(uncertainty::inputs_of(example(), Estimator::condensed, {}));
  SeededNumbers none(0, "");
  for (const uncertainty::BudgetLine& each : budget.lines) {
    const double step = 1e-4 * each.input.standard_uncertainty;
    InputErrors<double> error;
    error[each.input.quantity] = step;
    const double above = function(error, none);
    error[each.input.quantity] = -step;
    const double difference = (above - function(error, none)) / (2 * step);
    EXPECT_NEAR(each.sensitivity_m3_per_s, difference, 1e-3 * std::abs(difference) + 1e-14)
        << uncertainty::about(each.input.quantity).name;
  }
}

TEST(BudgetAtAPoint, ANewtonOfForceMapCountsWhatANewtonOfSpringTakesBack) {
  for (const Estimator estimator : {Estimator::condensed, Estimator::observer}) {
    const auto function = PointFunction::at(example(), estimator, middle());
    const uncertainty::Budget budget = function->budget(uncertainty::inputs_of(example(), estimator, {}), 2);
    const double per_force = line(budget, InputQuantity::magnetic_force_map).sensitivity_m3_per_s;
    EXPECT_GT(per_force, 0) << estimation::name(estimator);
    EXPECT_NEAR(line(budget, InputQuantity::spring).sensitivity_m3_per_s, -per_force, 0.05 * per_force);
    EXPECT_NEAR(line(budget, InputQuantity::flow_force_map).sensitivity_m3_per_s, -per_force, 0.05 * per_force);
    EXPECT_EQ(line(budget, InputQuantity::voltage_offset).contribution_m3_per_s, 0)
        << "the voltage shows the coil's resistance alone";
  }
}

TEST(BudgetAtAPoint, FrictionRulesTheCondensedSensorAndNotTheObserver) {
  const Scenario scenario;
  const auto share = [&](Estimator estimator) {
    const auto function = PointFunction::at(example(), estimator, middle());
    return line(function->budget(uncertainty::inputs_of(example(), estimator, {})), InputQuantity::friction).share;
  };
  EXPECT_GT(share(Estimator::condensed), 0.6);
  EXPECT_LT(share(Estimator::observer), 0.6);
}

TEST(BudgetAtAPoint, CountsOnceWhatReferencesOfTheMachineLeaveOpenOfFriction) {
  constexpr double left_open = 0.08;
  const auto friction_uncertainty = [](const model::Model& model) {
    const std::vector<uncertainty::InputUncertainty> all =
        uncertainty::inputs_of(model, Estimator::observer, {}).uncertainties;
    return std::ranges::find(all, InputQuantity::friction, &uncertainty::InputUncertainty::quantity)
        ->standard_uncertainty;
  };
  model::Model moved = example();
  moved.provenance.adaptations.emplace_back().wear.emplace().friction_share = left_open;
  sensor::ObserverParameters<double>& valve = moved.observer->parameters;
  for (double* share : {&valve.band.friction_share, &valve.environment.friction_share})
    *share = std::hypot(*share, left_open);
  EXPECT_NEAR(friction_uncertainty(moved), std::hypot(friction_uncertainty(example()), left_open), 1e-6);
}

TEST(BudgetAtAPoint, AgreesWithMonteCarloThroughTheObserver) {
  const auto function = PointFunction::at(example(), Estimator::observer, middle());
  const uncertainty::Budget budget = function->budget(uncertainty::inputs_of(example(), Estimator::observer, {}));
  const MonteCarlo check = monte_carlo(*function, budget, {.trials = 1500}, 1);
  // 1500 trials know the deviation to 2 %; the observer is nearly linear here.
  EXPECT_NEAR(check.comparison.deviation_ratio, 1, 0.08);
  SeededNumbers none(0, "");
  EXPECT_NEAR(check.figures.mean, (*function)({}, none), 0.2 * budget.combined_m3_per_s);
}

TEST(BudgetAtAPoint, ThereIsNoneOutsideTheMaps) {
  uncertainty::WorkingPoint beyond = middle();
  beyond.pressure_difference_Pa = 300e5;
  EXPECT_FALSE(PointFunction::at(example(), Estimator::condensed, beyond));
  EXPECT_FALSE(PointFunction::at(example(), Estimator::observer, beyond));
}

TEST(InputUncertainties, TheCampaignsInstrumentsGoBeforeDefaultsAndTheScenarioBeforeBoth) {
  model::Model model = example();
  model.instruments.current_A = 4e-3;
  model.instruments.force_N = 0.5;
  const auto input = [&](InputQuantity quantity, const uncertainty::InstrumentFigures& figures) {
    for (const auto& each : uncertainty::inputs_of(model, Estimator::observer, figures).uncertainties) {
      if (each.quantity == quantity) return each;
    }
    throw std::out_of_range("no such input");
  };
  EXPECT_NEAR(input(InputQuantity::current_offset, {}).standard_uncertainty, 4e-3 / 1.96, 1e-6);
  EXPECT_EQ(input(InputQuantity::current_gain, {}).standard_uncertainty, 0);
  EXPECT_GT(input(InputQuantity::magnetic_force_map, {}).standard_uncertainty, 0.5 / 1.96);
  uncertainty::InstrumentFigures asked;
  asked.current_offset_A = {1e-2, "scenario"};
  EXPECT_NEAR(input(InputQuantity::current_offset, asked).standard_uncertainty, 1e-2 / std::sqrt(3.0), 1e-9);
}

TEST(InputUncertainties, AResidualThatTheModelDoesNotStateIsNotZero) {
  model::Model model = example();
  for (model::Residual& residual : model.condensed.residuals) {
    if (residual.of == "flow rate") residual.of = "flow";
  }
  EXPECT_THAT([&] { (void)uncertainty::inputs_of(model, Estimator::condensed, {}); },
              ::testing::ThrowsMessage<model::ModelError>(::testing::HasSubstr("no residual of its flow rate")));
}

TEST(MonteCarlo, AdaptiveTrialsEndWhenTheFiguresAreStable) {
  const auto function = PointFunction::at(example(), Estimator::condensed, middle());
  const uncertainty::Budget budget = function->budget(uncertainty::inputs_of(example(), Estimator::condensed, {}));
  const MonteCarlo check =
      monte_carlo(*function, budget, {.trials = 300, .adaptive = true, .most_trials = 6000, .digits = 1}, 1);
  EXPECT_GE(check.figures.trials, 600U);
  EXPECT_LE(check.figures.trials, 6000U);
  EXPECT_EQ(check.figures.trials % 300, 0U);
}

TEST(MonteCarlo, StatesTheTrialsIntervalWhereFrictionIsTwoValuedAndTheBudgetsWhereItHolds) {
  const auto stated_at_middle = [](Estimator estimator, std::size_t trials) {
    const auto function = PointFunction::at(example(), estimator, middle());
    const uncertainty::Budget budget = function->budget(uncertainty::inputs_of(example(), estimator, {}));
    const MonteCarlo check = monte_carlo(*function, budget, {.trials = trials}, 1);
    SeededNumbers none(0, "");
    return std::pair(stated_interval(budget, (*function)({}, none), check), check.figures);
  };
  const auto [condensed, trials] = stated_at_middle(Estimator::condensed, 4000);
  EXPECT_FALSE(condensed.by_budget);
  EXPECT_EQ(condensed.lower, trials.lower);
  EXPECT_EQ(condensed.upper, trials.upper);
  EXPECT_LE(trials.shortest_upper - trials.shortest_lower, trials.upper - trials.lower);
  MonteCarlo agreeing;
  agreeing.comparison.validated = true;
  uncertainty::Budget budget;
  budget.expanded_m3_per_s = 2;
  const StatedInterval by_budget = stated_interval(budget, 10, agreeing);
  EXPECT_TRUE(by_budget.by_budget);
  EXPECT_EQ(by_budget.lower, 8);
  EXPECT_EQ(by_budget.upper, 12);
}

TEST(MonteCarlo, TheShortestIntervalLeavesOutTheThinTail) {
  std::vector<double> outputs;  // exponential: all probability near zero
  for (int k = 0; k < 1000; ++k) outputs.push_back(-std::log(1 - (k + 0.5) / 1000));
  const TrialFigures figures = figures_of(outputs);
  EXPECT_NEAR(figures.shortest_lower, 0, 0.01);
  EXPECT_NEAR(figures.shortest_upper, -std::log(0.05), 0.05);
  EXPECT_NEAR(figures.lower, -std::log(0.975), 0.01);
}

TEST(MonteCarlo, ToleranceIsHalfAUnitOfTheLastDigitThatCounts) {
  EXPECT_DOUBLE_EQ(numerical_tolerance(0.35, 1), 0.05);
  EXPECT_DOUBLE_EQ(numerical_tolerance(0.35, 2), 0.005);
  EXPECT_DOUBLE_EQ(numerical_tolerance(12, 2), 0.5);
}

/// The course that leads to the middle point, as a recording would hold it, so many times `slower`.
RunSamples course(bool with_reference, double slower = 1) {
  RunSamples run{"course", *uncertainty::course_to(example(), middle()), {}, {}};
  for (auto& sample : run.samples) sample.time_s *= slower;
  for (std::size_t k = 0; k < run.samples.size(); k += 3) run.instants.push_back(k);
  if (with_reference) {
    estimation::RunningSensor sensor(&example().observer->parameters, example().valve.rated_flow_m3_per_s);
    for (std::size_t k = 0; k < run.samples.size(); ++k) {
      const double flow = sensor.step(run.samples[k]).flow_m3_per_s;
      run.reference_m3_per_s.push_back(k + 20 < run.samples.size() ? NAN : flow);
    }
  }
  return run;
}

Scenario few_trials() {
  Scenario scenario;
  scenario.monte_carlo.trials_along_run = 60;
  scenario.run.reference_lag_ms = 0;
  return scenario;
}

TEST(BudgetAlongARun, EndsAsTheBudgetOfThePointWhereItEnds) {
  const RunAnalysis run = analyse_run(example(), course(false), few_trials(), 2, [](double) {});
  const auto function = PointFunction::at(example(), Estimator::observer, middle());
  const uncertainty::Budget budget = function->budget(uncertainty::inputs_of(example(), Estimator::observer, {}));
  ASSERT_EQ(run.results.size(), 2U);
  const RunResult& observer = run.results.back();
  // 16 noise runs instead of 48 measure the noise's part less well.
  EXPECT_NEAR(observer.combined_m3_per_s.back(), budget.combined_m3_per_s, 0.1 * budget.combined_m3_per_s);
  EXPECT_FALSE(observer.shares) << "there was no reference";
  double shares = 0;
  for (const RunLine& each : observer.lines) shares += each.share;
  EXPECT_NEAR(shares, 1, 1e-9);
}

/// Nothing but the sensor errs: oil and meter are not the campaign's, and the meter is right.
Scenario of_the_sensor_alone() {
  Scenario scenario = few_trials();
  scenario.run.other_bench = true;
  scenario.run.reference_meter_percent = 0;
  return scenario;
}

/// The observer's result along the course beside `reference(k)` [m3/s] at instant k; NaN elsewhere.
template <class Reference>
RunResult beside(const model::Model& model, const Scenario& scenario, const Reference& reference, double slower = 1) {
  RunSamples run = course(false, slower);
  run.reference_m3_per_s.assign(run.samples.size(), NAN);
  for (std::size_t k = 0; k < run.instants.size(); ++k) run.reference_m3_per_s[run.instants[k]] = reference(k);
  return analyse_run(model, run, scenario, 1, [](double) {}).results.back();
}

TEST(BudgetAlongARun, CountsTheReferencesInsideTheBandAndInsideTheBudgetsInterval) {
  const RunResult says = analyse_run(example(), course(false), of_the_sensor_alone(), 1, [](double) {}).results.back();
  // Of five instants three just inside, one just outside, one without a reference.
  const auto placed = [&](const auto& half_width_m3_per_s) {
    return *beside(example(), of_the_sensor_alone(), [&](std::size_t k) {
              constexpr std::array places{0.98, -0.98, 1.02, 0.0, double(NAN)};
              const double place = (k / 5) % 2 == 0 ? places[k % 5] : -places[k % 5];
              return says.flow_m3_per_s[k] + place * half_width_m3_per_s(k, place);
            }).shares;
  };
  const BandShares in_interval =
      placed([&](std::size_t k, double) { return says.coverage_factor * says.combined_m3_per_s[k]; });
  const double five = static_cast<double>(says.time_s.size()) / 5;
  EXPECT_NEAR(static_cast<double>(in_interval.instants), 4 * five, 1);
  EXPECT_NEAR(in_interval.in_budget_interval, 0.75, 1 / five);
  const BandShares in_band = placed([&](std::size_t k, double place) {
    return place > 0 ? says.upper_m3_per_s[k] - says.flow_m3_per_s[k] : says.flow_m3_per_s[k] - says.lower_m3_per_s[k];
  });
  EXPECT_NEAR(in_band.in_band, 0.75, 1 / five);
}

TEST(BudgetAlongARun, PredictsTheShareInTheBandThatAReferenceShowsWhoseErrorsAreTheBudgets) {
  std::vector<double> held;
  constexpr double to_bench_speed = 3;           // faster, friction's change with speed opens the band at any width
  for (const double width : {0.02, 0.1, 0.4}) {  // of the sensor's own band, which holds them all
    model::Model model = example();
    model.observer->parameters.band.coverage_factor *= width;
    const RunResult says =
        analyse_run(model, course(false, to_bench_speed), of_the_sensor_alone(), 1, [](double) {}).results.back();
    std::mt19937 random(1);
    std::normal_distribution<double> error(0, 1);
    const BandShares shares =
        *beside(
             model, of_the_sensor_alone(),
             [&](std::size_t k) { return says.flow_m3_per_s[k] + error(random) * says.combined_m3_per_s[k]; },
             to_bench_speed)
             .shares;
    // 134 references know a share to 4 % at worst (one standard deviation), and so do 60 trials at each of them: their
    // difference is known to 6 %.
    EXPECT_NEAR(shares.in_band_by_budget, shares.in_band, 0.08) << width;
    EXPECT_NEAR(shares.in_band_by_trials, shares.in_band, 0.1) << width;
    EXPECT_NEAR(shares.in_budget_interval, 0.95, 0.04) << width;
    held.push_back(shares.in_band);
  }
  EXPECT_GT(held.back(), held.front() + 0.04) << "a wider band holds more";
}

TEST(BudgetAlongARun, TheLagOfTheMeterIsNoErrorOfTheSensor) {
  constexpr double lag_s = 0.2;
  model::Model narrow = example();
  narrow.observer->parameters.band.coverage_factor *= 0.02;
  const RunSamples run = course(false);
  const std::vector<double> late = RunFunction(narrow, Estimator::observer, run).lagged_m3_per_s(lag_s);
  Scenario scenario = of_the_sensor_alone();
  scenario.run.reference_lag_ms = 1e3 * lag_s;
  const BandShares lagging = *beside(narrow, scenario, [&](std::size_t k) { return late[k]; }).shares;
  EXPECT_EQ(lagging.in_band, 1);
  EXPECT_EQ(lagging.in_budget_interval, 1);
  scenario.run.reference_lag_ms = 0;
  const BandShares prompt = *beside(narrow, scenario, [&](std::size_t k) { return late[k]; }).shares;
  EXPECT_LT(prompt.in_band, 0.9);
  EXPECT_DOUBLE_EQ(lagging.in_band_by_budget, prompt.in_band_by_budget);
  EXPECT_DOUBLE_EQ(lagging.in_band_by_trials, prompt.in_band_by_trials);
}

TEST(BudgetAlongARun, ErrorsOfOilAndMeterShowOnAnotherBenchOnly) {
  Scenario other = few_trials();
  other.run.other_bench = true;
  const auto predicted = [&](const Scenario& scenario) {
    return *analyse_run(example(), course(true), scenario, 1, [](double) {}).results.back().shares;
  };
  const BandShares same = predicted(few_trials());
  EXPECT_GT(same.in_band_by_budget, predicted(other).in_band_by_budget);
  EXPECT_GE(same.in_band_by_trials, predicted(other).in_band_by_trials);
}

TEST(BudgetAlongARun, ServesARunOfOneSampleAndRefusesOneWithout) {
  recording::Recording one;
  const auto put = [&](recording::Channel channel, double value) { one.column(channel) = {value}; };
  put(recording::Channel::time, 0);
  put(recording::Channel::current, 1.2);
  put(recording::Channel::position, 1e-3);
  const RunAnalysis run = analyse_run(example(), run_samples(one), few_trials(), 1, [](double) {});
  EXPECT_EQ(run.results.front().time_s.size(), 1U);
  EXPECT_TRUE(std::isfinite(run.results.back().combined_m3_per_s.front()));
  put(recording::Channel::position, NAN);
  EXPECT_THROW(static_cast<void>(run_samples(one)), recording::RecordingError);
}

}  // namespace
}  // namespace spoolflow::analysis
