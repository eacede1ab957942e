#pragma once
/// What the electronics of a whole 4/3 valve have, each sample.
#include "spoolflow/sensor/basis/sample.hpp"
#include "spoolflow/sensor/whole_valve/port_pressures.hpp"

namespace spoolflow::sensor {

template <class T>
struct WholeValveSample {
  T time_step_s{};  ///< since the sample before, >= 0
  T current_a_A{};  ///< coil currents, means over the step; solenoid a opens P to A, solenoid b P to B
  T current_b_A{};
  T voltage_a_V{};  ///< coil voltages, means over the step; may be missing
  T voltage_b_V{};
  T position_m{};  ///< of the spool from the centre, > 0 opens P to B
  T oil_temperature_K{};
  PortPressures<T> ports{};  ///< optional
};

/// What one side's electronics have, in that direction's signs.
template <class T>
constexpr Sample<T> sample_of(const WholeValveSample<T>& sample, bool side_a) {
  return {sample.time_step_s, side_a ? sample.current_a_A : sample.current_b_A,
          (side_a ? sample.voltage_a_V : sample.voltage_b_V), side_a ? -sample.position_m : sample.position_m,
          sample.oil_temperature_K};
}

/// Puts another current in place of one side's, which no voltage goes with.
template <class T>
constexpr void hold_current(WholeValveSample<T>& sample, bool side_a, T current_A) {
  (side_a ? sample.current_a_A : sample.current_b_A) = current_A;
  (side_a ? sample.voltage_a_V : sample.voltage_b_V) = std::numeric_limits<T>::quiet_NaN();
}

/// Why a sample cannot be estimated; see the same of one direction. Both currents are needed.
template <class T>
constexpr auto unusable(const WholeValveSample<T>& sample) {
  return unusable(sample_of(sample, false)) | when(!is_number(sample.current_a_A), Status::sample_missing);
}

}  // namespace spoolflow::sensor
