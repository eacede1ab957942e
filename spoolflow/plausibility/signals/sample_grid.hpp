#pragma once
/// The grid of time and value on which a recorder keeps position, currents and voltages.
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "spoolflow/recording/channels/channel.hpp"

namespace spoolflow::plausibility {

/// How many samples lie between one event and the next.
class Intervals {
 public:
  /// One sample further.
  void step() { ++since_; }
  void event() {
    if (since_ < count_.size()) ++count_[since_];
    since_ = 0;
  }
  /// The interval that nearly all are, or a multiple of it or one beside it, as a rate that divides no other has; 1:
  /// none.
  [[nodiscard]] std::size_t usual() const;

 private:
  std::array<std::uint32_t, 512> count_{};
  std::size_t since_ = 512;
};

/// One channel of a recording.
struct ChannelGrid {
  void take(double value);
  /// Samples that a slower recorder's value is held for; 1: none.
  [[nodiscard]] std::size_t held() const;
  /// Samples between the bends of straight pieces; 1: none.
  [[nodiscard]] std::size_t straight() const;

  double last = 0, before = 0, bend_power = 0;  ///< bend: second difference; its power as of some 500 samples
  double least_change = 0, change_sum = 0, changed = 0, largest = 0;
  double power_of_bends = 0, bends = 0, power_between = 0, between = 0;
  std::uint64_t in_row = 0;  ///< samples since one was missing
  Intervals changes, bent;
};

/// In bounded memory.
class SampleGrid {
 public:
  /// The next samples of each channel [SI]; NaN: missing; empty: the recording has none.
  void take(const std::array<std::vector<double>, recording::channel_count>& columns);

  /// One sentence where values come from a recorder of less than 400 Hz: a channel whose noise is finer than its
  /// changes repeats each value equally often, or two run straight between every so many samples. Empty: none.
  [[nodiscard]] std::string resampled() const;

  /// One sentence where a coil's current comes in steps of 0.7 % and more of its largest value. Empty: none.
  [[nodiscard]] std::string coarse_current() const;

 private:
  std::array<ChannelGrid, recording::channel_count> channels_{};
  double first_s_ = 0, last_s_ = 0, samples_ = 0;
};

}  // namespace spoolflow::plausibility
