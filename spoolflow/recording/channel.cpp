#include "spoolflow/recording/channel.hpp"

#include <algorithm>

namespace spoolflow::recording {
namespace {

using units::Dimension;

struct Entry {
  std::string_view name;
  Dimension dimension;
};
constexpr std::array<Entry, channel_count> entries{{
    {"time", Dimension::time},
    {"current", Dimension::current},
    {"current_set", Dimension::current},
    {"voltage", Dimension::voltage},
    {"position", Dimension::length},
    {"position_set", Dimension::ratio},
    {"force", Dimension::force},
    {"axial_force", Dimension::force},
    {"pressure_upstream", Dimension::pressure},
    {"pressure_downstream", Dimension::pressure},
    {"pressure_difference", Dimension::pressure},
    {"pressure_difference_set", Dimension::pressure},
    {"oil_temperature", Dimension::temperature},
    {"flow", Dimension::flow},
    {"flow_reference", Dimension::flow},
    {"test", Dimension::none},
}};

}  // namespace

std::string_view name(Channel channel) {
  return entries[static_cast<std::size_t>(channel)].name;
}

units::Dimension dimension(Channel channel) {
  return entries[static_cast<std::size_t>(channel)].dimension;
}

std::optional<Channel> channel_named(std::string_view name) {
  const auto found =
      std::find_if(entries.begin(), entries.end(), [&](const Entry& entry) { return entry.name == name; });
  if (found == entries.end()) return std::nullopt;
  return static_cast<Channel>(found - entries.begin());
}

const std::array<Channel, channel_count>& all_channels() {
  static const std::array<Channel, channel_count> all = [] {
    std::array<Channel, channel_count> out{};
    for (std::size_t k = 0; k < channel_count; ++k) out[k] = static_cast<Channel>(k);
    return out;
  }();
  return all;
}

}  // namespace spoolflow::recording
