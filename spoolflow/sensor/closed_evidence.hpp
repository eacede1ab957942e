#pragma once
/// Where the spool covers the metering edge no force shows the pressure difference, and nothing flows that would.
#include "spoolflow/sensor/pressure_difference.hpp"

namespace spoolflow::sensor {

/// Behind a closed valve the supply may do what it likes, however steady it has been.
template <class T>
constexpr void expect_change(const PressureParameters<T>& pressure, PressureState<T>& state) {
  state.process_noise = larger(state.process_noise, pressure.first_process_noise);
}

}  // namespace spoolflow::sensor
