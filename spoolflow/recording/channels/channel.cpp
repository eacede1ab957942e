#include "spoolflow/recording/channels/channel.hpp"

namespace spoolflow::recording {
namespace {

using units::Dimension;

struct Description {
  Channel channel;
  std::string_view name;
  Dimension dimension;
};

constexpr std::array<Description, channel_count> descriptions{{
    {Channel::time, "time", Dimension::time},
    {Channel::current, "current", Dimension::current},
    {Channel::current_set, "current_set", Dimension::current},
    {Channel::voltage, "voltage", Dimension::voltage},
    {Channel::position, "position", Dimension::length},
    {Channel::position_set, "position_set", Dimension::ratio},
    {Channel::force, "force", Dimension::force},
    {Channel::axial_force, "axial_force", Dimension::force},
    {Channel::pressure_upstream, "pressure_upstream", Dimension::pressure},
    {Channel::pressure_downstream, "pressure_downstream", Dimension::pressure},
    {Channel::pressure_difference, "pressure_difference", Dimension::pressure},
    {Channel::pressure_difference_set, "pressure_difference_set", Dimension::pressure},
    {Channel::oil_temperature, "oil_temperature", Dimension::temperature},
    {Channel::flow, "flow", Dimension::volume_flow},
    {Channel::flow_reference, "flow_reference", Dimension::volume_flow},
    {Channel::test, "test", Dimension::ratio},
    {Channel::current_a, "current_a", Dimension::current},
    {Channel::current_b, "current_b", Dimension::current},
    {Channel::voltage_a, "voltage_a", Dimension::voltage},
    {Channel::voltage_b, "voltage_b", Dimension::voltage},
    {Channel::pressure_p, "pressure_p", Dimension::pressure},
    {Channel::pressure_a, "pressure_a", Dimension::pressure},
    {Channel::pressure_b, "pressure_b", Dimension::pressure},
    {Channel::pressure_t, "pressure_t", Dimension::pressure},
}};

constexpr bool in_order_of_the_enumeration() {
  for (std::size_t k = 0; k < channel_count; ++k) {
    if (descriptions[k].channel != static_cast<Channel>(k)) return false;
  }
  return true;
}
static_assert(in_order_of_the_enumeration());

}  // namespace

std::string_view name(Channel channel) {
  return descriptions[static_cast<std::size_t>(channel)].name;
}

std::optional<Channel> channel_named(std::string_view name) {
  for (const Description& description : descriptions) {
    if (description.name == name) return description.channel;
  }
  return std::nullopt;
}

const std::array<Channel, channel_count>& all_channels() {
  static constexpr auto channels = [] {
    std::array<Channel, channel_count> out{};
    for (std::size_t k = 0; k < channel_count; ++k) out[k] = descriptions[k].channel;
    return out;
  }();
  return channels;
}

units::Dimension dimension(Channel channel) {
  return descriptions[static_cast<std::size_t>(channel)].dimension;
}

}  // namespace spoolflow::recording
