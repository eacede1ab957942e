/// Magnetic hysteresis comes out of loops at held positions, whatever the coil's model leaves of faster parts.
#include "spoolflow/calibration/fits/solenoid_dynamics.hpp"

#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/sensor/closed_form_valve.hpp"

namespace spoolflow::calibration {
namespace {

using Current = std::function<double(double time_s)>;

/// A bench that records forces of the coil of a valve in closed form, `late_s` behind its current.
class HeldBench {
 public:
  explicit HeldBench(const sensor::ActuatorParameters<double>& actuator) : actuator_(actuator) {}

  void record(int test, double end_s, double every_s, double late_s, const Current& current_A) {
    const auto behind = static_cast<std::size_t>(std::lround(late_s / every_s));
    std::vector<double> force_N;
    for (double time_s = 0; time_s < end_s; time_s += every_s) {
      const bool first = samples.size() == 0;
      const sensor::Sample<double> sample{every_s, current_A(time_s), std::nan(""), position_m, std::nan("")};
      force_N.push_back(sensor::step(actuator_, state_, sample, first).magnetic_force_N);
      samples.samples.push_back(sample);
      samples.time_s.push_back(static_cast<double>(samples.time_s.size()) * every_s);
      samples.test.push_back(test);
      samples.restarts.push_back(first ? 1 : 0);
      samples.force_N.push_back(force_N[force_N.size() > behind ? force_N.size() - 1 - behind : 0]);
    }
  }

  static constexpr double position_m = 1e-3;
  SolenoidSamples samples;

 private:
  const sensor::ActuatorParameters<double>& actuator_;
  sensor::ActuatorState<double> state_;
};

/// A slow loop and shrinking ones, then sines whose force comes late as no coil of one eddy current stage makes it.
SolenoidSamples loops_and_late_sines(const sensor::ActuatorParameters<double>& actuator) {
  HeldBench bench(actuator);
  bench.record(1, 8, 5e-3, 0, [](double t) { return t < 4 ? 0.5 * t : 0.5 * (8 - t); });
  bench.record(3, 8, 5e-3, 0, [](double t) { return 1 - std::cos(2 * std::numbers::pi * t) * (1 - t / 9); });
  bench.record(4, 1, 2e-4, 3e-3, [](double t) { return 1 + 0.4 * std::sin(2 * std::numbers::pi * 60 * t); });
  return bench.samples;
}

TEST(SolenoidDynamics, APartThatNoCoilOfTheModelMakesDoesNotBendTheLoopsOfTheOthers) {
  const sensor::ActuatorParameters<double> truth = sensor::closed_form_actuator<double>(sensor::closed_form);
  sensor::Coil<double> guess = truth.coil;
  for (double& stiffness : guess.hysteresis.stiffness) stiffness *= 0.5;
  const SolenoidDynamicsFit fit = fit_solenoid_dynamics(loops_and_late_sines(truth), guess, truth.magnetic_force);
  for (const double share : {0.1, 0.5, 0.9}) {
    const double expected_A = sensor::saturated_output(truth.coil.hysteresis, share);
    EXPECT_NEAR(sensor::saturated_output(fit.coil.hysteresis, share), expected_A, 0.05 * expected_A) << share;
  }
  for (const TestResidual& part : fit.tests) {
    if (part.test == 4) continue;
    EXPECT_LT(part.model_N.rms(), 0.1 * part.static_map_N.rms()) << part.test;
  }
}

TEST(SolenoidDynamics, NegativeCurrentSaysNothingOfAForceMapThatBeginsAtNone) {
  const sensor::ActuatorParameters<double> truth = sensor::closed_form_actuator<double>(sensor::closed_form);
  HeldBench bench(truth);
  bench.record(1, 8, 5e-3, 0, [](double t) { return t < 4 ? 0.5 * t : 0.5 * (8 - t); });
  bench.record(6, 2, 5e-3, 0, [](double t) { return 2 * (1 - t / 2) * std::cos(2 * std::numbers::pi * 4 * t); });
  for (std::size_t k = 0; k < bench.samples.size(); ++k)
    if (bench.samples.samples[k].current_A < 0) bench.samples.force_N[k] = 30 * -bench.samples.samples[k].current_A;
  sensor::Coil<double> guess = truth.coil;
  for (double& stiffness : guess.hysteresis.stiffness) stiffness *= 0.5;
  const SolenoidDynamicsFit fit = fit_solenoid_dynamics(bench.samples, guess, truth.magnetic_force);
  const double expected_A = sensor::saturated_output(truth.coil.hysteresis, 0.5);
  EXPECT_NEAR(sensor::saturated_output(fit.coil.hysteresis, 0.5), expected_A, 0.05 * expected_A);
}

}  // namespace
}  // namespace spoolflow::calibration
