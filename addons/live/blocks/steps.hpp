#pragma once
/// The steps in which a block's channels are written. Each is a power of two: a value on its grid is the whole number
/// times the step exactly, so that writer and reader of a block compute with the same values, bit for bit.
#include <array>
#include <cstdint>

#include "spoolflow/estimation/running_sensor.hpp"

namespace spoolflow::fleet {

/// A channel of a block; its index in the table is its bit.
struct BlockChannel {
  const char* name;
  double estimation::TimedSample::*member;  ///< null: a port pressure
  double sensor::PortPressures<double>::*port;
  double step;  ///< in the unit of the name; values reach to 2^31 - 1 steps to both sides
};
/// current_A is that of solenoid b where current_a_A is sent as well.
inline constexpr std::array<BlockChannel, 10> block_channels{{
    {"current_A", &estimation::TimedSample::current_A, nullptr, 0x1p-16},
    {"voltage_V", &estimation::TimedSample::voltage_V, nullptr, 0x1p-12},
    {"position_m", &estimation::TimedSample::position_m, nullptr, 0x1p-30},
    {"oil_temperature_K", &estimation::TimedSample::oil_temperature_K, nullptr, 0x1p-10},
    {"current_a_A", &estimation::TimedSample::current_a_A, nullptr, 0x1p-16},
    {"voltage_a_V", &estimation::TimedSample::voltage_a_V, nullptr, 0x1p-12},
    {"pressure_p_Pa", nullptr, &sensor::PortPressures<double>::p_Pa, 8.0},
    {"pressure_a_Pa", nullptr, &sensor::PortPressures<double>::a_Pa, 8.0},
    {"pressure_b_Pa", nullptr, &sensor::PortPressures<double>::b_Pa, 8.0},
    {"pressure_t_Pa", nullptr, &sensor::PortPressures<double>::t_Pa, 8.0},
}};

/// Of the time of samples [s]. Times reach to last_time steps to both sides, 136 years.
inline constexpr double time_step_s = 0x1p-30;
/// Far enough below 2^62 that the difference of two times, and a period more, fits 64 bits.
inline constexpr std::int64_t last_time = (std::int64_t{1} << 62U) - (std::int64_t{1} << 40U);
inline constexpr std::int64_t last_value = (std::int64_t{1} << 31U) - 1;

inline double& member(estimation::TimedSample& sample, const BlockChannel& channel) {
  return channel.member != nullptr ? sample.*channel.member : sample.ports.*channel.port;
}
inline const double& member(const estimation::TimedSample& sample, const BlockChannel& channel) {
  return channel.member != nullptr ? sample.*channel.member : sample.ports.*channel.port;
}

/// The sample as a block holds it: each value the nearest on its grid, or the last of the grid where it lies beyond.
/// NaN stays; infinite is only the current of a solenoid a that has no value now (estimation::of_both_coils), elsewhere
/// it becomes NaN. What is on the grids already stays as it is.
[[nodiscard]] estimation::TimedSample on_grid(estimation::TimedSample sample);

}  // namespace spoolflow::fleet
