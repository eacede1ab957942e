/// What the magnetic force may be wrong by in fast changes, where hardly any eddy currents explain it.
#include <cmath>

#include <gtest/gtest.h>

#include "spoolflow/calibration/fits/actuator_fit.hpp"
#include "spoolflow/model/describe_observer.hpp"
#include "tests/sensor/closed_form_valve.hpp"

namespace spoolflow::calibration {
namespace {

/// A second of a current that goes to and fro at 20 Hz, the force behind it by half a millisecond.
SolenoidSamples late_force(const sensor::ActuatorParameters<double>& actuator) {
  constexpr double step_s = 1e-3, angular_1_per_s = 126, late_s = 5e-4;
  SolenoidSamples out;
  sensor::ActuatorState<double> state;
  for (int k = 0; k < 1000; ++k) {
    const auto current_A = [&](double time_s) { return 1.2 + 0.6 * std::sin(angular_1_per_s * time_s); };
    const double time_s = step_s * k;
    const auto sample = [&](double at_A) {
      return sensor::Sample<double>{step_s, at_A, std::nan(""), 1e-3, std::nan("")};
    };
    out.samples.push_back(sample(current_A(time_s)));
    out.time_s.push_back(time_s);
    out.test.push_back(4);
    out.restarts.push_back(k == 0 ? 1 : 0);
    out.force_N.push_back(sensor::step(actuator, state, sample(current_A(time_s - late_s)), k == 0).magnetic_force_N);
  }
  return out;
}

TEST(ActuatorUncertainty, StaysWhatAModelHoldsHoweverSmallTheEddyCurrentsAre) {
  for (const double classical_A_per_V : {1e-3, 1e-5, 1e-9, 0.0}) {
    sensor::ActuatorParameters<double> actuator = sensor::closed_form_actuator<double>(sensor::closed_form);
    actuator.coil.eddy_currents.classical_A_per_V = classical_A_per_V;
    actuator.force_uncertainty_N = 0.1;
    fit_uncertainty(actuator, late_force(actuator));
    EXPECT_GE(actuator.eddy_uncertainty, 0);
    EXPECT_LE(actuator.eddy_uncertainty, model::largest_eddy_uncertainty);
    // What eddy currents do not explain is the force's or the current's.
    if (classical_A_per_V > 1e-8) continue;
    EXPECT_GT(std::hypot(actuator.force_uncertainty_N, actuator.current_uncertainty_A), 0.1);
  }
}

}  // namespace
}  // namespace spoolflow::calibration
