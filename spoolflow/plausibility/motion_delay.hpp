#pragma once
/// Position and coil current whose times are not the same.
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "spoolflow/recording/channels/channel.hpp"

namespace spoolflow::plausibility {

/// The first five minutes of one run, in bounded memory.
class MotionDelay {
 public:
  /// The next samples of each channel [SI]; NaN: missing; empty: the recording has none. Reads time, position and the
  /// coil's current, of a whole valve that of coil b less that of coil a, which moves the spool the other way.
  void take(const std::array<std::vector<double>, recording::channel_count>& columns);

  /// By how much the position follows the current later than a spool does [s]; < 0: it comes before the current.
  /// In pieces of ten seconds, the shift within 5 s at which their changes over 30 ms correlate best; the median of the
  /// pieces in which they do so by `least_motion_correlation`, as long as a spool moves and clearly at one shift, where
  /// three and most of them agree: strokes that come again and again fit at many, as friction turns the current long
  /// before the spool. Nothing where that is what a spool and its position sensor take, where the run moves too slowly,
  /// or where its samples are more than 10 ms apart.
  [[nodiscard]] std::optional<double> late_s() const;

 private:
  void add(double time_s, double position_m, double current_A);

  std::vector<double> position_m_, current_A_;  ///< sums over 10 ms, then their means; NaN where there is no sample
  double begin_s_ = 0, samples_ = 0;            ///< of the last 10 ms
  bool begun_ = false;
};

/// "position comes 0.16 s late …"
[[nodiscard]] std::string shown_delay(double late_s);

}  // namespace spoolflow::plausibility
