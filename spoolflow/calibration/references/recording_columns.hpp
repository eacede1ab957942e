#pragma once
#include "spoolflow/estimation/columns.hpp"
#include "spoolflow/recording/recording.hpp"

namespace spoolflow::calibration {

/// What the sensor reads of a recording, which must outlive it.
[[nodiscard]] inline estimation::Columns columns_of(const recording::Recording& recording) {
  using recording::Channel;
  return {.time_s = recording[Channel::time],
          .current_A = recording[Channel::current],
          .voltage_V = recording.column(Channel::voltage),
          .position_m = recording[Channel::position],
          .oil_temperature_K = recording.column(Channel::oil_temperature)};
}

}  // namespace spoolflow::calibration
