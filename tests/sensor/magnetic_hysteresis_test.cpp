#include "spoolflow/sensor/magnetic_hysteresis.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace spoolflow::sensor {
namespace {

MagneticHysteresis<double> solenoid() {
  MagneticHysteresis<double> hysteresis;
  for (unsigned k = 0; k < hysteresis_elements; ++k) {
    hysteresis.threshold[k] = 0.001 * std::pow(2.0, k);
    hysteresis.stiffness[k] = 3.0 / (1 + k);
    hysteresis.stiffness_increase[k] = 0.5 * k;
  }
  hysteresis.per_full_flux = 1 / 0.4;
  return hysteresis;
}

/// The stop operator by definition: follows each change and stays within its threshold on both sides.
struct TextbookStops {
  std::array<double, hysteresis_elements> deflection{};

  double output(const MagneticHysteresis<double>& hysteresis, double change, double flux) const {
    double out = 0;
    for (unsigned k = 0; k < hysteresis_elements; ++k) {
      out += (hysteresis.stiffness[k] +
              std::min(1.0, std::abs(flux) * hysteresis.per_full_flux) * hysteresis.stiffness_increase[k]) *
             moved(hysteresis, k, change);
    }
    return out;
  }
  double moved(const MagneticHysteresis<double>& hysteresis, unsigned k, double change) const {
    return std::clamp(deflection[k] + change, -hysteresis.threshold[k], hysteresis.threshold[k]);
  }
  void move(const MagneticHysteresis<double>& hysteresis, double change) {
    for (unsigned k = 0; k < hysteresis_elements; ++k) deflection[k] = moved(hysteresis, k, change);
  }
};

TEST(MagneticHysteresis, FollowsTheStopOperatorsDefinitionThroughAnyHistory) {
  const auto hysteresis = solenoid();
  HysteresisState<double> state;
  TextbookStops textbook;
  std::mt19937 generator(7);
  std::normal_distribution<double> small(0, 0.003), large(0, 0.08);
  for (int n = 0; n < 20000; ++n) {
    const double flux = std::clamp(state.flux + (n % 17 == 0 ? large(generator) : small(generator)), -0.5, 0.5);
    const double change = flux - state.flux;
    const HysteresisPoint<double> point = hysteresis_at(hysteresis, state, flux);
    ASSERT_NEAR(point.value, textbook.output(hysteresis, change, flux), 1e-12) << n;
    const double further = std::copysign(1e-9, change);
    const double output = textbook.output(hysteresis, change + further, flux);
    if (std::abs(flux) < 0.5) {  // back at the end of the range all stops reach their thresholds at once: two slopes
      ASSERT_NEAR(point.slope, (output - point.value) / further, 1e-3) << n;
    }
    advance(hysteresis, state, flux);
    textbook.move(hysteresis, change);
    for (unsigned k = 0; k < hysteresis_elements; ++k)
      ASSERT_NEAR(deflection(state, k), textbook.deflection[k], 1e-13) << n << ' ' << k;
  }
}

}  // namespace
}  // namespace spoolflow::sensor
