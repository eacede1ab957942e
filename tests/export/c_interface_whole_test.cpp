#include <cmath>
#include <limits>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "spoolflow/export/c_interface/spoolflow.h"
#include "tests/export/exported_folder.hpp"

namespace spoolflow::exports {
namespace {

struct DestroyWhole {
  void operator()(spoolflow_sensor* sensor) const { spoolflow_destroy(sensor); }
};
using WholeSensor = std::unique_ptr<spoolflow_sensor, DestroyWhole>;

WholeSensor running(const model::Model& model, spoolflow_estimator estimator = SPOOLFLOW_BEST) {
  std::ostringstream text;
  write_model(text, model);
  spoolflow_sensor* sensor = nullptr;
  char message[256];
  EXPECT_EQ(
      spoolflow_create_from_memory(text.str().data(), text.str().size(), estimator, &sensor, message, sizeof message),
      SPOOLFLOW_OK)
      << message;
  return WholeSensor(sensor);
}

/// A spool that swings through the centre, its currents with it; made up.
spoolflow_whole_sample swinging(int k) {
  const double swing = std::sin(0.002 * k);
  const double current_b_A = swing > 0 ? 1.6 * swing : 0.0;
  const double current_a_A = swing < 0 ? -1.6 * swing : 0.0;
  return {1e-3 * k, current_a_A, current_b_A, 3 * current_a_A, 3 * current_b_A, 1.9e-3 * swing, 318.0};
}

spoolflow_estimate answered(const WholeSensor& sensor, const spoolflow_whole_sample& sample) {
  spoolflow_estimate estimate{};
  EXPECT_EQ(spoolflow_step_whole(sensor.get(), &sample, &estimate), SPOOLFLOW_OK);
  return estimate;
}

TEST(CInterfaceOfAWholeValve, GivesSignedFlowFromBothSolenoids) {
  for (const spoolflow_estimator estimator : {SPOOLFLOW_CONDENSED, SPOOLFLOW_OBSERVER}) {
    const WholeSensor sensor = running(whole_example_model(), estimator);
    EXPECT_EQ(spoolflow_is_whole(sensor.get()), 1);
    EXPECT_EQ(spoolflow_runs(sensor.get()), estimator);
    double most = 0, least = 0;
    for (int k = 0; k < 6300; ++k) {
      const spoolflow_estimate estimate = answered(sensor, swinging(k));
      ASSERT_LE(estimate.flow_lower_m3_per_s, estimate.flow_m3_per_s);
      ASSERT_LE(estimate.flow_m3_per_s, estimate.flow_upper_m3_per_s);
      most = std::max(most, estimate.flow_m3_per_s);
      least = std::min(least, estimate.flow_m3_per_s);
    }
    EXPECT_GT(most, 0.1 * spoolflow_rated_flow(sensor.get()));
    EXPECT_LT(least, -0.1 * spoolflow_rated_flow(sensor.get()));
  }
}

TEST(CInterfaceOfAWholeValve, TakesTheActiveCoilAloneAsIfTheOtherCarriedNothing) {
  const WholeSensor both = running(whole_example_model()), active = running(whole_example_model());
  for (int k = 0; k < 6300; ++k) {
    const spoolflow_whole_sample in = swinging(k);
    const bool a = in.position_m < 0;
    const spoolflow_sample own{in.time_s, a ? in.current_a_A : in.current_b_A, a ? in.voltage_a_V : in.voltage_b_V,
                               in.position_m, in.oil_temperature_K};
    spoolflow_estimate estimate{};
    ASSERT_EQ(spoolflow_step(active.get(), &own, &estimate), SPOOLFLOW_OK);
    ASSERT_EQ(estimate.flow_m3_per_s, answered(both, in).flow_m3_per_s) << k;
  }
}

TEST(CInterfaceOfAWholeValve, TakesTheFlowFromThePressuresOfAllFourPorts) {
  const WholeSensor without = running(whole_example_model()), with = running(whole_example_model());
  const spoolflow_port_pressures regenerative{50e5, 2e5, 70e5, 1e5};
  spoolflow_estimate estimate{};
  spoolflow_whole_sample in{};
  for (int k = 0; k < 700; ++k) {
    in = swinging(k);
    EXPECT_EQ(spoolflow_step_whole_ports(without.get(), &in, nullptr, &estimate), SPOOLFLOW_OK);
    EXPECT_EQ(estimate.status & SPOOLFLOW_STATUS_FLOW_REVERSED, 0U);
    EXPECT_EQ(spoolflow_step_whole_ports(with.get(), &in, &regenerative, &estimate), SPOOLFLOW_OK);
  }
  EXPECT_LT(estimate.flow_upper_m3_per_s, 0);
  EXPECT_NE(estimate.status & SPOOLFLOW_STATUS_FLOW_REVERSED, 0U);
  EXPECT_GT(answered(without, in).flow_m3_per_s, 0);
  EXPECT_EQ(spoolflow_step_whole_ports(with.get(), nullptr, &regenerative, &estimate), SPOOLFLOW_BAD_ARGUMENT);
}

TEST(CInterfaceOfAWholeValve, StepsColumnsExactlyAsSamples) {
  const WholeSensor one = running(whole_example_model()), all = running(whole_example_model());
  constexpr int count = 4000;
  std::vector<double> time_s, current_a_A, current_b_A, position_m, flow(count), expected;
  for (int k = 0; k < count; ++k) {
    spoolflow_whole_sample in = swinging(k);
    time_s.push_back(in.time_s);
    current_a_A.push_back(in.current_a_A);
    current_b_A.push_back(in.current_b_A);
    position_m.push_back(in.position_m);
    in.voltage_a_V = in.voltage_b_V = in.oil_temperature_K = NAN;
    expected.push_back(answered(one, in).flow_m3_per_s);
  }
  spoolflow_whole_inputs inputs{};
  inputs.time_s = time_s.data();
  inputs.current_a_A = current_a_A.data();
  inputs.current_b_A = current_b_A.data();
  inputs.position_m = position_m.data();
  spoolflow_outputs outputs{};
  outputs.flow_m3_per_s = flow.data();
  ASSERT_EQ(spoolflow_step_whole_arrays(all.get(), count, &inputs, &outputs), SPOOLFLOW_OK);
  EXPECT_EQ(flow, expected);
  inputs.current_a_A = nullptr;
  EXPECT_EQ(spoolflow_step_whole_arrays(all.get(), count, &inputs, &outputs), SPOOLFLOW_BAD_ARGUMENT);
}

TEST(CInterfaceOfAWholeValve, HoldsTheAnswerWhereEitherCurrentIsMissing) {
  const WholeSensor sensor = running(whole_example_model());
  double before = 0;
  for (int k = 0; k < 600; ++k) before = answered(sensor, swinging(k)).flow_m3_per_s;
  for (const bool a : {true, false}) {
    spoolflow_whole_sample sample = swinging(a ? 600 : 601);
    (a ? sample.current_a_A : sample.current_b_A) = std::numeric_limits<double>::quiet_NaN();
    const spoolflow_estimate held = answered(sensor, sample);
    EXPECT_EQ(held.status, SPOOLFLOW_STATUS_SAMPLE_MISSING);
    EXPECT_EQ(held.flow_m3_per_s, before);
  }
  EXPECT_EQ(answered(sensor, swinging(602)).status & SPOOLFLOW_STATUS_SAMPLE_MISSING, 0U);
}

TEST(CInterfaceOfAWholeValve, KnowsNothingBeforeTheFirstSampleWithBothCurrents) {
  const WholeSensor sensor = running(whole_example_model());
  const double rated = spoolflow_rated_flow(sensor.get());
  for (int k = 0; k < 3; ++k) {
    spoolflow_whole_sample sample = swinging(k);
    sample.current_a_A = std::numeric_limits<double>::quiet_NaN();
    const spoolflow_estimate unknown = answered(sensor, sample);
    EXPECT_EQ(unknown.flow_lower_m3_per_s, -rated);
    EXPECT_EQ(unknown.flow_upper_m3_per_s, rated);
  }
  EXPECT_GT(answered(sensor, swinging(3)).flow_lower_m3_per_s, -rated);
}

TEST(CInterfaceOfAWholeValve, IsRefusedForAModelOfOneDirection) {
  const WholeSensor sensor = running(example_model());
  EXPECT_EQ(spoolflow_is_whole(sensor.get()), 0);
  const spoolflow_whole_sample sample = swinging(0);
  spoolflow_estimate estimate{};
  EXPECT_EQ(spoolflow_step_whole(sensor.get(), &sample, &estimate), SPOOLFLOW_BAD_ARGUMENT);
}

}  // namespace
}  // namespace spoolflow::exports
