#pragma once
/// What a valve's coil can carry: a current or a voltage far beyond what its calibration saw is none, its instrument or
/// line is broken.
#include <cmath>
#include <limits>

#include "spoolflow/sensor/condensed.hpp"
#include "spoolflow/sensor/observer_parameters.hpp"

namespace spoolflow::estimation {

/// No coil current is larger than so many times the largest that was calibrated; drivers boost by less.
inline constexpr double implausible_current_ratio = 1.5;
/// No coil voltage is larger than so many times the largest that calibration saw: its supply may have been the half.
inline constexpr double implausible_voltage_ratio = 2.5;
/// Where calibration saw no voltage, or the model is older: so many times the voltage that holds the largest current.
inline constexpr double implausible_holding_voltage_ratio = 12;

/// The largest current [A] and voltage [V] that are accepted, either way.
struct CoilLimits {
  double current_A = std::numeric_limits<double>::infinity();
  double voltage_V = std::numeric_limits<double>::infinity();
};

template <class T>
CoilLimits coil_limits(const sensor::ObserverParameters<T>& valve) {
  CoilLimits out{.current_A = implausible_current_ratio * static_cast<double>(valve.largest_current_A)};
  const double seen_V = static_cast<double>(valve.largest_voltage_V);
  const double holding_V = static_cast<double>(valve.largest_current_A * valve.actuator.coil_resistance.resistance_Ohm);
  if (seen_V > 0) {
    out.voltage_V = implausible_voltage_ratio * seen_V;
  } else if (holding_V > 0) {
    out.voltage_V = implausible_holding_voltage_ratio * holding_V;
  }
  return out;
}

/// The condensed sensor reads no voltage.
template <class T>
CoilLimits coil_limits(const sensor::CondensedTables<T>& valve) {
  return {.current_A = implausible_current_ratio * sensor::CondensedLayout::current_cells /
                       static_cast<double>(valve.cells_per_A)};
}

/// Of both solenoids; of a valve of one direction twice the same.
struct SolenoidLimits {
  CoilLimits b, a;
};

/// `valve`: as the sensors take them, of one direction or whole.
template <class Valve>
SolenoidLimits solenoid_limits(const Valve& valve) {
  if constexpr (requires { valve.a; }) {
    return {coil_limits(*valve.b), coil_limits(*valve.a)};
  } else {
    return {coil_limits(valve), coil_limits(valve)};
  }
}

/// Takes a value beyond the limit away: what was implausible is not measured, `missing`. Returns whether it did.
inline bool take_away(double& value, double limit, double missing) {
  const bool implausible = std::abs(value) > limit && !std::isinf(value);
  if (implausible) value = missing;
  return implausible;
}

}  // namespace spoolflow::estimation
