#include "spoolflow/export/golden_points.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "spoolflow/export/number_groups.hpp"
#include "spoolflow/sensor/observer.hpp"
#include "tests/export/exported_folder.hpp"

namespace spoolflow::exports {
namespace {

TEST(GoldenPoints, MoveTheValveThroughEveryModeOfTheObserver) {
  const model::Model model = example_model();
  sensor::ObserverState<double> state;
  std::array<int, 4> motions{};
  int faults = 0, missing = 0, closed = 0;
  for (const DirectionPoint& point : golden_points(model)) {
    const auto& in = point.sample;
    const auto estimate =
        step(model.observer->parameters, state,
             sensor::Sample<double>{in.time_step_s, in.current_A, in.voltage_V, in.position_m, in.oil_temperature_K});
    ++motions[static_cast<std::size_t>(state.position.motion)];
    faults += has(estimate.status, sensor::Status::position_fault) ? 1 : 0;
    missing += has(estimate.status, sensor::Status::sample_missing) ? 1 : 0;
    closed += has(estimate.status, sensor::Status::closed) ? 1 : 0;
    EXPECT_EQ(estimate.flow_m3_per_s, point.best_m3_per_s);
  }
  for (const int count : motions) EXPECT_GT(count, 10);
  EXPECT_GT(faults, 10);
  EXPECT_EQ(missing, 1);
  EXPECT_GT(closed, 10);
}

TEST(GoldenPoints, StayTheSameInSinglePrecision) {
  const model::Model model = example_model();
  const SinglePrecisionError error = single_precision_error(model, golden_points(model));
  EXPECT_LT(error.condensed_percent, 0.1);
  EXPECT_LT(error.best_percent, 0.1);
  EXPECT_GT(error.best_percent, 0.0);  // it is another precision
}

TEST(GoldenPoints, OfAWholeValveOpenBothSidesOneAfterTheOther) {
  const model::Model model = whole_example_model();
  double most_m3_per_s = 0, least_m3_per_s = 0;
  int both_coils = 0;
  for (const WholeValvePoint& point : whole_golden_points(model)) {
    if (point.sample.position_m > 1e-4F) {
      EXPECT_GE(point.best_m3_per_s, 0);
    } else if (point.sample.position_m < -1e-4F) {
      EXPECT_LE(point.best_m3_per_s, 0);
    }
    most_m3_per_s = std::max(most_m3_per_s, point.best_m3_per_s);
    least_m3_per_s = std::min(least_m3_per_s, point.best_m3_per_s);
    both_coils += point.sample.current_a_A > 0.1F && point.sample.current_b_A > 0.1F ? 1 : 0;
  }
  EXPECT_GT(most_m3_per_s, 0.2 * model.valve.rated_flow_m3_per_s);
  EXPECT_LT(least_m3_per_s, -0.2 * model.valve.rated_flow_m3_per_s);
  EXPECT_GT(both_coils, 10);
}

TEST(GoldenPoints, OfAWholeValveStayTheSameInSinglePrecision) {
  const model::Model model = whole_example_model();
  const SinglePrecisionError error = single_precision_error(model, whole_golden_points(model));
  EXPECT_LT(error.condensed_percent, 0.1);
  EXPECT_LT(error.best_percent, 0.1);
  EXPECT_GT(error.best_percent, 0.0);  // it is another precision
}

TEST(NumberGroups, NoticeAParameterThatNobodyDescribed) {
  const std::array<double, 3> parameters{1, 2, 3};
  NumberGroups groups(&parameters);
  groups.number({.key = "first", .unit = "1", .limits = {0, 1}, .meaning = ""}, parameters[0]);
  groups.number({.key = "last", .unit = "1", .limits = {0, 1}, .meaning = ""}, parameters[2]);
  EXPECT_THROW((void)groups.in_order(3), std::logic_error);
  groups.number({.key = "middle", .unit = "1", .limits = {0, 1}, .meaning = ""}, parameters[1]);
  EXPECT_EQ(groups.in_order(3).size(), 3U);
  EXPECT_THROW((void)groups.in_order(4), std::logic_error);
}

TEST(NumberGroups, WriteFloatsThatAreReadBackTheSame) {
  EXPECT_EQ(float_literal(0.1), "0.1F");
  EXPECT_EQ(float_literal(3), "3.0F");
  EXPECT_EQ(float_literal(1e-40), "0.0F");  // no denormals in the valve
  for (const double number : {1.0 / 3, 6.02214076e23, 1.17549435e-38, -7.7755e-5}) {
    EXPECT_EQ(std::stof(float_literal(number)), static_cast<float>(number));
  }
}

}  // namespace
}  // namespace spoolflow::exports
