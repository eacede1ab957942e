#pragma once
/// Channels that an amplifier, a converter or a recorder clips.
#include <array>
#include <string>
#include <vector>

#include "spoolflow/numerics/held_extremes.hpp"
#include "spoolflow/recording/channels/channel.hpp"

namespace spoolflow::plausibility {

/// Position, currents, forces, pressures and flows of one recording, in bounded memory. A voltage is not asked: its
/// amplifier gives no more than its supply has.
class ClippedChannels {
 public:
  /// The next samples of each channel [SI]; NaN: missing; empty: the recording has none.
  void take(const std::array<std::vector<double>, recording::channel_count>& columns);

  /// A sentence for each channel that stands at 999, 9999 or their negative, in its usual unit, as its highest or
  /// lowest value: a marker of missing values. Empty: none.
  [[nodiscard]] std::vector<std::string> missing_markers() const;

  /// A sentence for each channel that stands at its highest or lowest value for a thousandth of the samples, while its
  /// noise moves it everywhere else. A channel without noise, or whose resolution is coarser than its noise, is not
  /// named, nor one that stands at zero, where pump or coil is off, nor where it stands at a marker.
  /// Empty: none.
  [[nodiscard]] std::vector<std::string> findings() const;

 private:
  /// A channel that stands at one of its ends.
  struct Held {
    recording::Channel channel;
    bool high;
    std::string value;  ///< with its unit
    double share;       ///< of the samples
  };
  [[nodiscard]] std::vector<Held> held(bool at_markers) const;

  std::array<numerics::HeldExtremes, recording::channel_count> extremes_;
};

}  // namespace spoolflow::plausibility
