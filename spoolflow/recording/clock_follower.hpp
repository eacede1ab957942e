#pragma once
/// Columns of one clock, followed along the times of another.
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "spoolflow/recording/column_clock.hpp"
#include "spoolflow/recording/files/sample_table.hpp"

namespace spoolflow::recording {

/// A column of time stamps in seconds: gain * raw + offset.
struct TimeScale {
  double gain = 1, offset = 0;
};

/// What the times of a clock are like.
struct ClockSpan {
  double begin_s = 0, end_s = 0;
  double step_s = 0;  ///< median of the first 2000 steps; 0 of fewer than two times
};

/// Reads all times of a clock. Throws RecordingError: a missing time stamp, one before the one before it.
[[nodiscard]] ClockSpan span_of(SampleTable& table, const ColumnClock& clock, TimeScale scale, const std::string& file);

/// Values at rising times from a stream of samples at others. Memory: the samples of one window and a block.
class ClockFollower {
 public:
  /// `columns` of `table` are those that values() gives, at times of `clock` that span_of() has accepted. `window_s`: 0
  /// for linear interpolation, else the width of the window about a time over which the line through the samples is
  /// averaged.
  ClockFollower(std::unique_ptr<SampleTable> table, std::vector<std::size_t> columns, const ColumnClock& clock,
                TimeScale scale, const ClockSpan& span, double window_s);

  /// One value a column: NaN outside the clock's span and in gaps of more than ten steps.
  void values(double time_s, std::span<double> out);

 private:
  bool fetch();
  void forget_before(double time_s);
  [[nodiscard]] double at(std::size_t column, double time_s, std::size_t after) const;

  std::unique_ptr<SampleTable> table_;
  ColumnClock clock_;
  TimeScale scale_;
  ClockSpan span_;
  double window_s_;
  std::uint64_t read_ = 0;
  std::deque<double> times_s_;
  std::vector<std::deque<double>> values_;
  std::vector<std::vector<double>> block_;
};

}  // namespace spoolflow::recording
