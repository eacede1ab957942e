/// Figures of what the estimate does: envelope, directions, steps, frequencies.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/report/figures/svg_figure.hpp"
#include "spoolflow/report/validation/validation_figures.hpp"
#include "tests/report/markup.hpp"

namespace spoolflow::report {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

model::Model calibrated() {
  model::Model model{};
  model.valve = {"valve", 80 / 60000.0, 2.4e-3, "b"};
  model.condensed.position_m = {0, 2.4e-3};
  model.condensed.current_A = {0, 2.6};
  model.condensed.pressure_difference_Pa = {5e5, 70e5};
  model.condensed.oil_temperature_K = 323.15;
  model.evidence.axial_force = {{70e5, {0, 1.2e-3, 2.4e-3}, {}, {}, {0, 5e-4, 1.3e-3}, {}}};
  return model;
}

const Mark* named(const CaptionedFigure& figure, const std::string& name) {
  for (const Mark& mark : figure.figure.panels.front().marks) {
    if (mark.name.str() == name) return &mark;
  }
  return nullptr;
}

TEST(EnvelopeFigures, DistinguishExtrapolatedPointsFromCalibratedOnes) {
  validation::RunResult run;
  run.operating_points = {{1e-3, 60e5}, {1e-3, 80e5}, {2.5e-3, 20e5}};
  run.solenoid_points = {{1e-3, 1.0}};
  run.flow_points = {{1e-3, 2e-4}};
  run.oil_temperature_K = validation::Extent{320, 340};
  const std::vector<CaptionedFigure> figures = envelope_figures(calibrated(), {run});
  ASSERT_EQ(figures.size(), 4U);
  const Mark* outside = named(figures[0], "used, extrapolated");
  ASSERT_NE(outside, nullptr);
  EXPECT_EQ(outside->y.size(), 2U);
  EXPECT_NEAR(outside->y.front(), 80e5, 1e-3);
  EXPECT_EQ(named(figures[0], "used by the runs")->x.size(), 1U);
  EXPECT_GT(figures[0].figure.panels.front().highest, 80e5);
  EXPECT_EQ(named(figures[2], "used, extrapolated"), nullptr);
  ASSERT_EQ(figures[3].figure.panels.front().rows.size(), 2U);
  EXPECT_THAT(figures[3].figure.panels.front().rows[1].label, HasSubstr("extrapolated"));
  for (const CaptionedFigure& figure : figures) EXPECT_EQ(unbalanced_markup(svg_of(figure.figure, {}, "f")), "");
}

TEST(EnvelopeFigures, OfAWholeValveAreCalibratedOnBothSidesOfTheCentre) {
  model::Model whole = calibrated();
  whole.valve.direction = "both";
  whole.p_to_a = model::Direction{whole.condensed, {}, whole.evidence};
  whole.p_to_a->condensed.pressure_difference_Pa.upper = 40e5;
  validation::RunResult run;
  run.operating_points = {{-1e-3, 30e5}, {-1e-3, 60e5}, {1e-3, 60e5}};
  run.solenoid_points = {{-1e-3, -1.0}, {1e-3, 1.0}, {1e-3, -1.0}};
  run.flow_points = {{-1e-3, -2e-4}};
  const std::vector<CaptionedFigure> figures = envelope_figures(whole, {run});
  ASSERT_GE(figures.size(), 3U);
  EXPECT_EQ(named(figures[0], "used by the runs")->x.size(), 2U);
  EXPECT_NEAR(named(figures[0], "used, extrapolated")->x.front(), -1e-3, 1e-9) << "P to A was calibrated up to 40 bar";
  EXPECT_LT(*figures[1].figure.panels.front().lowest, -1.3e-3) << "flow P to A is below zero";
  EXPECT_EQ(named(figures[2], "used, extrapolated")->y.size(), 1U) << "coil a with the spool on coil b's side";
  for (const CaptionedFigure& figure : figures) EXPECT_EQ(unbalanced_markup(svg_of(figure.figure, {}, "f")), "");
}

TEST(EnvelopeFigures, OfRunsThatRecordedLittleAreLeftOut) {
  EXPECT_TRUE(envelope_figures(calibrated(), {}).empty());
  EXPECT_TRUE(envelope_figures(calibrated(), {validation::RunResult{}}).empty());
}

TEST(DirectionFigures, NameTheHysteresisAndWhereItIs) {
  const double full_scale = 1e-3;
  validation::Validation validation;
  validation::PooledResult& pooled = validation.pooled.emplace_back();
  pooled.estimator = estimation::Estimator::observer;
  pooled.direction = validation::DirectionProfile({2.4e-3, full_scale});
  validation::ErrorProfile profile(1, full_scale);
  for (int k = 0; k < 2400; ++k) {
    pooled.direction->add(validation::Direction::opening, 1e-6 * k, 0.02 * full_scale);
    pooled.direction->add(validation::Direction::closing, 1e-6 * k, k > 2300 ? -0.03 * full_scale : 0.0);
    profile.add(0.5, 0.02 * full_scale);
  }
  pooled.profiles = {profile};
  const std::vector<CaptionedFigure> figures = direction_and_distribution_figures(validation, full_scale);
  ASSERT_EQ(figures.size(), 2U);
  EXPECT_THAT(figures[0].caption.str(), HasSubstr("observer: at most 5.0 % FS, at 2.35 mm"));
  EXPECT_NEAR(named(figures[0], "observer, opening")->y.front(), 2, 1e-9);
  EXPECT_NEAR(named(figures[1], "observer")->y.back(), 100, 1e-9);
  EXPECT_THAT(direction_table(validation, full_scale).str(), HasSubstr("closes"));
  EXPECT_THAT(direction_table(validation, full_scale).str(), Not(HasSubstr("rests")));
}

TEST(DynamicsFigures, GiveDelayRiseAndCorner) {
  validation::RunResult run;
  EXPECT_TRUE(dynamics_figures(run).empty());
  run.step_response = validation::StepResponse{3,
                                               0.044,
                                               {-0.1, 0, 0.1},
                                               {0, 0.5, 1},
                                               {{estimation::Estimator::observer, 2, -0.012, 0.06, 0.05, {0, 0.6F, 1}},
                                                {estimation::Estimator::condensed, 0, NAN, NAN, NAN, {}}}};
  validation::EstimatorResult& result = run.results.emplace_back();
  result.estimator = estimation::Estimator::observer;
  result.frequency_response = validation::FrequencyResponse{{{0.5, 1, -0.1, 1}, {5, 0.6, -1, 0.9}}, 3.21};
  const std::vector<CaptionedFigure> figures = dynamics_figures(run);
  ASSERT_EQ(figures.size(), 2U);
  EXPECT_THAT(figures[0].caption.str(),
              HasSubstr("observer: 12 ms before the meter, 60 ms from 10 to 90 %, 5 % overshoot"));
  EXPECT_THAT(figures[0].caption.str(), HasSubstr("The condensed sensor follows none"));
  EXPECT_THAT(figures[1].caption.str(), HasSubstr("3 dB at 3.21 Hz"));
  const std::string drawing = svg_of(figures[1].figure, {}, "f");
  EXPECT_THAT(drawing, HasSubstr(">0.5<"));
  EXPECT_THAT(drawing, HasSubstr(">5<"));
  EXPECT_THAT(drawing, Not(HasSubstr(">100<")));
  EXPECT_EQ(unbalanced_markup(drawing), "");
}

}  // namespace
}  // namespace spoolflow::report
