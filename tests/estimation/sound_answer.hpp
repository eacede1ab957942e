#pragma once
/// What must hold for every answer of a sensor, in double and in single precision: it is a number inside its band.
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <string>

#include "spoolflow/estimation/running_sensor.hpp"
#include "tests/estimation/random_valve.hpp"

namespace spoolflow::estimation {

/// What is wrong with an answer; empty where nothing is.
template <class T>
std::string flaw(const sensor::Estimate<T>& estimate) {
  for (const T value : {estimate.flow_m3_per_s, estimate.flow_lower_m3_per_s, estimate.flow_upper_m3_per_s,
                        estimate.pressure_difference_Pa, estimate.magnetic_force_N, estimate.spring_force_N,
                        estimate.flow_force_N, estimate.friction_force_N}) {
    if (!std::isfinite(value)) return "not finite";
  }
  if (!(estimate.flow_lower_m3_per_s <= estimate.flow_m3_per_s)) return "lower end above the flow";
  if (!(estimate.flow_m3_per_s <= estimate.flow_upper_m3_per_s)) return "upper end below the flow";
  return estimate.pressure_difference_Pa < 0 ? "negative pressure difference" : "";
}

/// Numbers as the valve has them.
template <template <class> class Parameters>
std::unique_ptr<Parameters<float>> in_single_precision(const Parameters<double>& valve) {
  constexpr std::size_t count = sizeof(Parameters<float>) / sizeof(float);
  const auto numbers = std::bit_cast<std::array<double, count>>(valve);
  auto single = std::make_unique<std::array<float, count>>();
  for (std::size_t k = 0; k < count; ++k) {
    const auto number = static_cast<float>(numbers[k]);
    (*single)[k] = std::abs(number) < std::numeric_limits<float>::min() ? 0.0F : number;
  }
  return std::make_unique<Parameters<float>>(std::bit_cast<Parameters<float>>(*single));
}

inline std::string flaw_in_double(RunningSensor::Parameters valve, RandomSamples samples, int count) {
  RunningSensor sensor(valve, 1e-3);
  for (int k = 0; k < count; ++k) {
    const std::string found = flaw(sensor.step(samples.next()));
    if (!found.empty()) return found + " at sample " + std::to_string(k);
  }
  return "";
}

template <class Valve, class State>
inline std::string flaw_in_single(const Valve& valve, State state, RandomSamples samples, int count) {
  double last_s = 0;
  for (int k = 0; k < count; ++k) {
    const TimedSample sample = samples.next();
    const std::string found =
        flaw(step(valve, state,
                  {static_cast<float>(sample.time_s - last_s), static_cast<float>(sample.current_A),
                   static_cast<float>(sample.voltage_V), static_cast<float>(sample.position_m),
                   static_cast<float>(sample.oil_temperature_K)}));
    if (!found.empty()) return found + " at sample " + std::to_string(k);
    if (std::isfinite(sample.time_s)) last_s = sample.time_s;
  }
  return "";
}

}  // namespace spoolflow::estimation
