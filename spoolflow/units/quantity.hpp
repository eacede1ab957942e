#pragma once
/// Typed quantities for text: a number in SI that knows what it is of, so that whoever writes it out chooses its unit.
#include <cstdint>

namespace spoolflow::units {

enum class Kind : std::uint8_t {
  flow,
  pressure,
  length,
  force,
  temperature,
  temperature_difference,
  current,
  time,
  voltage
};

struct Quantity {
  Kind kind;
  double value_SI;
};

constexpr Quantity flow(double flow_m3_per_s) {
  return {Kind::flow, flow_m3_per_s};
}
constexpr Quantity pressure(double pressure_Pa) {
  return {Kind::pressure, pressure_Pa};
}
constexpr Quantity length(double length_m) {
  return {Kind::length, length_m};
}
constexpr Quantity force(double force_N) {
  return {Kind::force, force_N};
}
constexpr Quantity temperature(double temperature_K) {
  return {Kind::temperature, temperature_K};
}
constexpr Quantity temperature_difference(double difference_K) {
  return {Kind::temperature_difference, difference_K};
}
constexpr Quantity current(double current_A) {
  return {Kind::current, current_A};
}
constexpr Quantity time(double time_s) {
  return {Kind::time, time_s};
}
constexpr Quantity voltage(double voltage_V) {
  return {Kind::voltage, voltage_V};
}

}  // namespace spoolflow::units
