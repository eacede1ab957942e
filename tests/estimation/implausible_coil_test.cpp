/// Coil currents and voltages that no coil carries: broken amplifiers and lines.
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "spoolflow/estimation/running_sensor.hpp"
#include "tests/sensor/valve_course.hpp"

namespace spoolflow::estimation {
namespace {

using sensor::ClosedFormValve;
using sensor::Status;

constexpr double every_s = 1e-3;
constexpr double rated_m3_per_s = 1e-3;

/// Slides open, rests, and slides on.
std::vector<sensor::ValveSample> run_of_a_valve() {
  sensor::Course course({.position_m = 0.4e-3, .pressure_difference_Pa = 60e5});
  course.rest(0.1, 1).slide(1.4e-3, 1).rest(0.2, 0.5).slide(2.2e-3, 0.5).slide(1e-3, 0.5);
  return sensor::ClosedFormRun(sensor::closed_form, course).sampled(course.end_s(), every_s);
}

struct Coil {
  double current_A, voltage_V;
};

/// Half a second of `broken` in the middle of the run: how the answers to it were.
struct UnderFault {
  int samples = 0, coil_fault = 0, sample_missing = 0, inside = 0;
};
template <class Broken>
UnderFault under(const sensor::ObserverParameters<double>& valve, const Broken& broken) {
  RunningSensor running(&valve, rated_m3_per_s);
  UnderFault out;
  double time_s = 0;
  for (const sensor::ValveSample& sample : run_of_a_valve()) {
    Coil coil{sample.measured.current_A, sample.measured.voltage_V};
    time_s += every_s;
    const bool faulty = time_s > 1.2 && time_s < 1.7;
    if (faulty) coil = broken(coil);
    const auto answer = running.step({time_s, coil.current_A, coil.voltage_V, sample.measured.position_m, 313});
    if (!faulty) continue;
    ++out.samples;
    out.coil_fault += has(answer.status, Status::coil_fault) ? 1 : 0;
    out.sample_missing += has(answer.status, Status::sample_missing) ? 1 : 0;
    out.inside +=
        answer.flow_lower_m3_per_s <= sample.flow_m3_per_s && sample.flow_m3_per_s <= answer.flow_upper_m3_per_s ? 1
                                                                                                                 : 0;
  }
  return out;
}

sensor::ObserverParameters<double> calibrated_valve() {
  sensor::ObserverParameters<double> valve = sensor::closed_form_observer<double>(sensor::closed_form);
  valve.largest_voltage_V = 24;
  return valve;
}

TEST(ImplausibleCoil, ACurrentBeyondWhatWasCalibratedIsMissingFromItsFirstSampleOn) {
  for (const double current_A : {4.0, 8.0, 20.0, -20.0, 1e6}) {
    const UnderFault fault = under(calibrated_valve(), [&](Coil coil) { return Coil{current_A, coil.voltage_V}; });
    EXPECT_EQ(fault.coil_fault, fault.samples) << current_A;
    EXPECT_EQ(fault.sample_missing, fault.samples) << current_A;
    EXPECT_GT(fault.inside, 0.95 * fault.samples) << current_A;
  }
}

TEST(ImplausibleCoil, AVoltageOfSeveralSuppliesIsMissingAndTheFlowGoesOn) {
  const sensor::ObserverParameters<double> known = calibrated_valve();
  sensor::ObserverParameters<double> older = known;
  older.largest_voltage_V = 0;  // 12 times 25 V
  for (const double voltage_V : {400.0, -400.0, 1e5}) {
    for (const auto& valve : {known, older}) {
      const UnderFault fault = under(valve, [&](Coil coil) { return Coil{coil.current_A, voltage_V}; });
      EXPECT_EQ(fault.coil_fault, fault.samples) << voltage_V;
      EXPECT_EQ(fault.sample_missing, 0) << voltage_V;
      EXPECT_GT(fault.inside, 0.95 * fault.samples) << voltage_V;
    }
  }
}

TEST(ImplausibleCoil, WhatTheCalibrationSawAndALittleMoreIsTaken) {
  const UnderFault boosted = under(calibrated_valve(), [](Coil coil) { return Coil{coil.current_A, 48.0}; });
  EXPECT_LT(boosted.coil_fault, boosted.samples) << "only by the resistance, later";
  const UnderFault saturated = under(calibrated_valve(), [](Coil coil) { return Coil{3.5, coil.voltage_V}; });
  EXPECT_EQ(saturated.sample_missing, 0) << "answered at the map's edge";
}

TEST(ImplausibleCoil, OneThatIsBrokenFromTheStartIsNoFirstAnswer) {
  const sensor::ObserverParameters<double> valve = calibrated_valve();
  RunningSensor running(&valve, rated_m3_per_s);
  const auto answer = running.step({0, 20, 10, 1e-3, 313});
  EXPECT_EQ(answer.flow_m3_per_s, 0);
  EXPECT_EQ(answer.flow_upper_m3_per_s, rated_m3_per_s);
  EXPECT_TRUE(has(answer.status, Status::coil_fault));
}

TEST(ImplausibleCoil, OfEitherSolenoidOfAWholeValveHoldsItsAnswer) {
  const sensor::ObserverParameters<double> valve = calibrated_valve();
  RunningSensor running(sensor::WholeValveParameters<double>{&valve, &valve}, rated_m3_per_s);
  double time_s = 0;
  sensor::Estimate<double> before{};
  for (const sensor::ValveSample& sample : run_of_a_valve()) {
    const auto& measured = sample.measured;
    before = running.step(
        of_both_coils({time_s += every_s, 0, measured.current_A, 0, measured.voltage_V, measured.position_m, 313}));
  }
  for (const std::array<double, 2> currents_A : {std::array{20.0, 1.0}, std::array{0.0, -20.0}}) {
    const auto held = running.step(of_both_coils({time_s += every_s, currents_A[0], currents_A[1], 0, 10, 1e-3, 313}));
    EXPECT_EQ(held.flow_m3_per_s, before.flow_m3_per_s);
    EXPECT_TRUE(has(held.status, Status::coil_fault) && has(held.status, Status::sample_missing));
  }
}

TEST(ImplausibleCoil, OfTheActiveSolenoidAloneIsFoundToo) {
  const sensor::ObserverParameters<double> valve = calibrated_valve();
  RunningSensor running(sensor::WholeValveParameters<double>{&valve, &valve}, rated_m3_per_s);
  EXPECT_FALSE(has(running.step({0, 1, 10, -1e-3, 313}).status, Status::coil_fault));
  const Status broken = running.step({1e-3, 20, 10, -1e-3, 313}).status;
  EXPECT_TRUE(has(broken, Status::coil_fault) && has(broken, Status::sample_missing));
}

}  // namespace
}  // namespace spoolflow::estimation
