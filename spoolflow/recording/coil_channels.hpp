#pragma once
/// Which channels belong to the coils.
#include "spoolflow/recording/channels/channel.hpp"

namespace spoolflow::recording {

/// Whether the currents of both coils of a whole valve were recorded. `Source`: Recording or SampleBlock.
template <class Source>
[[nodiscard]] bool has_both_coils(const Source& source) {
  return !source.column(Channel::current_a).empty() && !source.column(Channel::current_b).empty();
}

/// Current and voltage of coil b where both coils' are there; else of the only or the active one.
struct CoilChannels {
  Channel current, voltage;
};
template <class Source>
[[nodiscard]] CoilChannels coil_channels(const Source& source) {
  if (has_both_coils(source)) return {Channel::current_b, Channel::voltage_b};
  return {Channel::current, Channel::voltage};
}

}  // namespace spoolflow::recording
