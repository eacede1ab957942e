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

/// The name used in file headers and channel maps, and what the values are; `position_set` and `test` are ratios.
struct ChannelDescription {
  Channel channel;
  std::string_view name;
  units::Dimension dimension;
};
inline constexpr auto channel_descriptions = std::to_array<ChannelDescription>({
    {Channel::time, "time", units::Dimension::time},
    {Channel::current, "current", units::Dimension::current},
    {Channel::current_set, "current_set", units::Dimension::current},
    {Channel::voltage, "voltage", units::Dimension::voltage},
    {Channel::position, "position", units::Dimension::length},
    {Channel::position_set, "position_set", units::Dimension::ratio},
    {Channel::force, "force", units::Dimension::force},
    {Channel::axial_force, "axial_force", units::Dimension::force},
    {Channel::pressure_upstream, "pressure_upstream", units::Dimension::pressure},
    {Channel::pressure_downstream, "pressure_downstream", units::Dimension::pressure},
    {Channel::pressure_difference, "pressure_difference", units::Dimension::pressure},
    {Channel::pressure_difference_set, "pressure_difference_set", units::Dimension::pressure},
    {Channel::oil_temperature, "oil_temperature", units::Dimension::temperature},
    {Channel::flow, "flow", units::Dimension::volume_flow},
    {Channel::flow_reference, "flow_reference", units::Dimension::volume_flow},
    {Channel::test, "test", units::Dimension::ratio},
    {Channel::current_a, "current_a", units::Dimension::current},
    {Channel::current_b, "current_b", units::Dimension::current},
    {Channel::voltage_a, "voltage_a", units::Dimension::voltage},
    {Channel::voltage_b, "voltage_b", units::Dimension::voltage},
    {Channel::pressure_p, "pressure_p", units::Dimension::pressure},
    {Channel::pressure_a, "pressure_a", units::Dimension::pressure},
    {Channel::pressure_b, "pressure_b", units::Dimension::pressure},
    {Channel::pressure_t, "pressure_t", units::Dimension::pressure},
});
inline constexpr std::size_t channel_count = channel_descriptions.size();

/// In the order of the enumeration.
inline constexpr auto all_channels = [] {
  std::array<Channel, channel_count> out{};
  for (std::size_t k = 0; k < channel_count; ++k) out[k] = channel_descriptions[k].channel;
  return out;
}();
static_assert([] {
  for (std::size_t k = 0; k < channel_count; ++k) {
    if (all_channels[k] != static_cast<Channel>(k)) return false;
  }
  return true;
}());

[[nodiscard]] constexpr std::string_view name(Channel channel) {
  return channel_descriptions[static_cast<std::size_t>(channel)].name;
}
[[nodiscard]] constexpr units::Dimension dimension(Channel channel) {
  return channel_descriptions[static_cast<std::size_t>(channel)].dimension;
}
[[nodiscard]] constexpr std::optional<Channel> channel_named(std::string_view name) {
  for (const ChannelDescription& description : channel_descriptions) {
    if (description.name == name) return description.channel;
  }
  return std::nullopt;
}

}  // namespace spoolflow::recording
