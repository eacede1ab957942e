/// Whatever a sensor went through, what it remembers afterwards is a state that it takes back.
#include "spoolflow/estimation/state_check.hpp"

#include <vector>

#include <gtest/gtest.h>

#include "tests/estimation/sample_faults.hpp"
#include "tests/estimation/straight_valve.hpp"
#include "tests/sensor/valve_course.hpp"

namespace spoolflow::estimation {
namespace {

constexpr double kept_every_s = 1e-3;

/// Opens, and goes back; of a whole valve with a silent other coil.
std::vector<TimedSample> kept_run(bool whole) {
  sensor::Course course({.position_m = 0.4e-3, .pressure_difference_Pa = 60e5});
  course.rest(0.1, 1).slide(1.4e-3, 0.4).rest(0.1, -1).slide(0.6e-3, 0.3);
  std::vector<TimedSample> out;
  for (const auto& sample : sensor::ClosedFormRun(sensor::closed_form, course).sampled(course.end_s(), kept_every_s)) {
    const sensor::Sample<double>& measured = sample.measured;
    out.push_back({kept_every_s * static_cast<double>(out.size()), measured.current_A, measured.voltage_V,
                   measured.position_m, measured.oil_temperature_K});
    if (whole) out.back().current_a_A = out.back().voltage_a_V = 0;
  }
  return out;
}

/// Every state after a fault that comes once, and after one that lasts for a tenth of a second.
void expect_kept_every_state_taken_back(const char* sensor, const RunningSensor::Parameters& parameters, bool whole) {
  const std::vector<TimedSample> run = kept_run(whole);
  const std::size_t begins = run.size() / 3;
  for (const SampleFault& fault : sample_faults) {
    for (const std::size_t lasts : {1U, 100U}) {
      RunningSensor running(parameters, 1e-3);
      std::size_t refused = 0;
      for (std::size_t k = 0; k < run.size(); ++k) {
        TimedSample sample = run[k];
        if (k >= begins && k < begins + lasts) fault.happens(sample);
        (void)running.step(sample);
        refused += may_be_running_state(&running.state()) ? 0U : 1U;
      }
      EXPECT_EQ(refused, 0U) << sensor << ": " << fault.name << " of " << lasts << " samples";
    }
  }
}

sensor::ObserverParameters<double> guarded_valve() {
  auto valve = sensor::closed_form_observer<double>(sensor::closed_form);
  valve.current_limits = {0.2, 490};
  return valve;
}

TEST(KeptState, OfTheObserverIsTakenBackAfterEveryKindOfFault) {
  const auto valve = guarded_valve();
  expect_kept_every_state_taken_back("observer", &valve, false);
  const sensor::WholeValveParameters<double> whole{&valve, &valve};
  expect_kept_every_state_taken_back("observer of a whole valve", whole, true);
  expect_kept_every_state_taken_back("observer of a whole valve, active coil's current", whole, false);
}

TEST(KeptState, OfTheCondensedSensorIsTakenBackAfterEveryKindOfFault) {
  const sensor::CondensedParameters<double> valve = straight_valve();
  expect_kept_every_state_taken_back("condensed", &valve, false);
  expect_kept_every_state_taken_back("condensed of a whole valve", RunningSensor::WholeCondensed{&valve, &valve}, true);
}

TEST(KeptState, WithAnAnswerThatIsNoNumberIsRefused) {
  const auto valve = guarded_valve();
  RunningSensor running(&valve, 1e-3);
  for (const TimedSample& sample : kept_run(false)) (void)running.step(sample);
  EXPECT_TRUE(may_be_running_state(&running.state()));
  running.state().observer.last.flow_m3_per_s = not_measured;
  EXPECT_FALSE(may_be_running_state(&running.state()));
}

}  // namespace
}  // namespace spoolflow::estimation
