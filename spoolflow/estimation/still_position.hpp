#pragma once
/// A position signal that stands still bit for bit while the current moves: no sensor with noise does, its line or
/// converter hangs.
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace spoolflow::estimation {

/// Of one position channel, causal. What a sound channel repeats is learnt from the channel itself, so that coarse
/// resolution and records that hold each value for several samples are not faults.
struct StillPosition {
  double last_m = std::numeric_limits<double>::quiet_NaN();
  double lowest_m = std::numeric_limits<double>::infinity(), highest_m = -std::numeric_limits<double>::infinity();
  double last_change_m = 0;
  double lowest_A = 0, highest_A = 0;            ///< since the position changed
  std::uint32_t changes = 0, repetitions = 0;    ///< samples that differ from the one before, and that do not
  std::uint32_t reversals = 0;                   ///< changes against the one before: noise, if many
  std::uint32_t driven = 0, longest_driven = 0;  ///< repetitions since the current moved; the most of a sound signal
  std::uint32_t hanging = 0;                     ///< not 0: it hangs; a number, since states come back as bytes

  /// Whether the position [m] of this sample is one that hangs: since it changed last, the current [A] has moved by a
  /// fiftieth of `largest_current_A`, and after that it has repeated itself for twenty samples and four times what it
  /// ever did before. Not at the ends of the range that the channel has shown (a converter clips there, a spool rests
  /// on its stop), and not on a channel whose noise does not show: before a thousand of its
  /// changes went against the one before, or where a quarter of all samples are repetitions.
  bool hangs(double position_m, double current_A, double largest_current_A) {
    constexpr std::uint32_t least_reversals = 1000, least_repetitions = 20, times_longest = 4, changes_a_repetition = 3;
    constexpr double current_share = 0.02;
    if (std::isnan(position_m)) return false;
    if (position_m != last_m) {
      // What was called hanging says nothing of a sound channel.
      if (hanging == 0 && driven > longest_driven) longest_driven = driven;
      hanging = driven = 0;
      const double change_m = position_m - last_m;
      reversals +=
          static_cast<std::uint32_t>(change_m * last_change_m < 0);  // without a branch: noise goes as it likes
      if (!std::isnan(change_m)) last_change_m = change_m;
      last_m = position_m;
      lowest_A = highest_A = current_A;
      ++changes;
      lowest_m = lesser(lowest_m, position_m);
      highest_m = greater(highest_m, position_m);
      return false;
    }
    lowest_A = lesser(lowest_A, current_A);
    highest_A = greater(highest_A, current_A);
    if (hanging == 0) ++repetitions;
    if (highest_A - lowest_A > current_share * largest_current_A) ++driven;
    const bool inside = position_m > lowest_m && position_m < highest_m;
    const bool noisy = reversals > least_reversals && changes / changes_a_repetition > repetitions;
    if (inside && noisy && driven > least_repetitions + times_longest * longest_driven) hanging = 1;
    return hanging != 0;
  }

 private:
  /// What fmin and fmax say, which leave the sign of a zero to whoever compiles them: states have the same bytes
  /// wherever they are made.
  static double lesser(double kept, double value) { return value < kept || std::isnan(kept) ? value : kept; }
  static double greater(double kept, double value) { return value > kept || std::isnan(kept) ? value : kept; }
};
static_assert(std::is_trivially_copyable_v<StillPosition>);

}  // namespace spoolflow::estimation
