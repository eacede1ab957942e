#include "spoolflow/plausibility/clipped_channel.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "spoolflow/plausibility/limits.hpp"
#include "spoolflow/plausibility/relation.hpp"

namespace spoolflow::plausibility {
namespace {

using recording::Channel;

constexpr std::array watched{
    Channel::position, Channel::current,        Channel::current_a,          Channel::current_b,
    Channel::force,    Channel::axial_force,    Channel::pressure_upstream,  Channel::pressure_downstream,
    Channel::flow,     Channel::flow_reference, Channel::pressure_difference};

/// Noise moves the signal from one sample to the next wherever it does not stand at an end.
bool is_fine(const numerics::HeldExtremes& signal) {
  const auto samples = static_cast<double>(signal.samples), repeated = static_cast<double>(signal.repeated);
  const double held = static_cast<double>(signal.at_lowest + signal.at_highest);
  return repeated - held <= most_repeated_share * samples &&
         static_cast<double>(signal.reversals) >= least_reversal_share * (samples - repeated);
}

bool is_clipped(const numerics::HeldExtremes& signal, double end, double held) {
  const double size = std::max(std::abs(signal.lowest), std::abs(signal.highest));
  return held >= fewest_clipped && held >= clipped_share * static_cast<double>(signal.samples) &&
         std::abs(end) > near_zero_share * size;
}

/// "-999 mm"
bool is_marker(std::string_view value) {
  if (value.starts_with('-')) value.remove_prefix(1);
  return value.starts_with("999 ") || value.starts_with("9999 ");
}

}  // namespace

void ClippedChannels::take(const std::array<std::vector<double>, recording::channel_count>& columns) {
  for (const Channel channel : watched) {
    const auto k = static_cast<std::size_t>(channel);
    for (const double value : columns[k]) extremes_[k].take(value);
  }
}

std::vector<ClippedChannels::Held> ClippedChannels::held(bool at_markers) const {
  std::vector<Held> out;
  for (const Channel channel : watched) {
    const numerics::HeldExtremes& signal = extremes_[static_cast<std::size_t>(channel)];
    if (!(signal.lowest < signal.highest) || !is_fine(signal)) continue;
    for (const bool high : {true, false}) {
      const double end = high ? signal.highest : signal.lowest;
      const auto samples = static_cast<double>(high ? signal.at_highest : signal.at_lowest);
      const std::string value = shown_value(channel, end);
      if (is_clipped(signal, end, samples) && is_marker(value) == at_markers)
        out.push_back({channel, high, value, samples / static_cast<double>(signal.samples)});
    }
  }
  return out;
}

std::vector<std::string> ClippedChannels::missing_markers() const {
  std::vector<std::string> out;
  for (const Held& each : held(true))
    out.push_back(fmt::format(
        "{} is {} for {:.2g} % of the samples, a marker of missing values and no measured one: leave those samples "
        "empty, or write nan",
        recording::name(each.channel), each.value, 100 * each.share));
  return out;
}

std::vector<std::string> ClippedChannels::findings() const {
  std::vector<std::string> out;
  for (const Held& each : held(false))
    out.push_back(fmt::format(
        "{} stands at its {} value, {}, to the last digit for {:.2g} % of the samples, and its noise moves it "
        "elsewhere: an amplifier, a converter or the recorder clips it; widen its range and record it again, or cut "
        "those parts",
        recording::name(each.channel), each.high ? "highest" : "lowest", each.value, 100 * each.share));
  return out;
}

}  // namespace spoolflow::plausibility
