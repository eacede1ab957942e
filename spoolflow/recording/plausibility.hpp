#pragma once
/// Refuses numbers that no valve's recording holds in the unit they were said to be in: bar read as Pa, mA read as A,
/// mm read as m, K read as degC, ms read as s.
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "spoolflow/recording/channel_binding.hpp"

namespace spoolflow::recording {

/// Two checks a channel. Beyond a limit: more than 1 % of a block's samples are larger (or, for temperatures, lower)
/// than the quantity can be; single wild samples are the sensor's to judge. Too small: over the whole recording the
/// channel carries a signal, yet stays below what the quantity reaches, and another unit that is at least a hundred
/// times larger would explain it. A channel that is zero, or only noise about zero, is never too small.
class Plausibility {
 public:
  Plausibility(std::string file, const std::vector<BoundColumn>& columns, std::optional<double> stroke_m);

  /// `values` in SI, `place` returns where row k of them stands. Throws RecordingError.
  void take(std::size_t column, std::span<const double> values, const std::function<std::string(std::size_t)>& place);
  /// At the end of the recording. Throws RecordingError.
  void finish() const;

 private:
  /// Limits in SI; see the table in plausibility.cpp.
  struct Limits {
    double lowest;
    double highest;
    double smallest;
    const char* reason;
    bool level_is_signal;  ///< a constant value away from zero counts as a signal: pressures are held, positions rest
  };
  struct Watched {
    const BoundColumn* column;
    Limits limits;
    bool may_be_too_small;  ///< there is a unit a hundred times larger
    std::uint64_t samples = 0;
    double lowest;
    double highest;
    double sum = 0.0;
    double steps = 0.0;  ///< sum of the differences from sample to sample, without sign
    double last;
  };

  static double largest(const Watched& watched);
  static Limits limits_of(Channel channel, std::optional<double> stroke_m);
  [[nodiscard]] std::string better_units(const Watched& watched, double value, double least_factor) const;
  void check_sampling(const Watched& time, std::span<const double> time_s) const;

  std::string file_;
  std::optional<double> stroke_m_;
  std::vector<Watched> watched_;
};

}  // namespace spoolflow::recording
