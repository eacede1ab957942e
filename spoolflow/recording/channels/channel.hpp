#pragma once
/// The physical quantities that a recording can hold, each with its SI unit.
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "spoolflow/units/unit.hpp"

namespace spoolflow::recording {

/// A measured or commanded quantity. Values are kept in SI: s, A, V, m, N, Pa, K, m3/s.
/// `position_set` is the share of the stroke, 0 (closed) to 1 (fully open); below 0 a whole valve opens P to A. `test`
/// numbers the parts of a protocol. `current` and `voltage` are of the only or the active coil, `current_a` and so on
/// of the coils that open P to A and P to B; `pressure_p` to `pressure_t` are those at the valve's ports.
enum class Channel : std::uint8_t {
  time,
  current,
  current_set,
  voltage,
  position,
  position_set,
  force,
  axial_force,
  pressure_upstream,
  pressure_downstream,
  pressure_difference,
  pressure_difference_set,
  oil_temperature,
  flow,
  flow_reference,
  test,
  current_a,
  current_b,
  voltage_a,
  voltage_b,
  pressure_p,
  pressure_a,
  pressure_b,
  pressure_t,
};
inline constexpr std::size_t channel_count = 24;

/// The name used in file headers and channel maps, such as "oil_temperature".
[[nodiscard]] std::string_view name(Channel channel);
[[nodiscard]] std::optional<Channel> channel_named(std::string_view name);
[[nodiscard]] const std::array<Channel, channel_count>& all_channels();
/// What its values are; `position_set` and `test` are ratios.
[[nodiscard]] units::Dimension dimension(Channel channel);

}  // namespace spoolflow::recording
