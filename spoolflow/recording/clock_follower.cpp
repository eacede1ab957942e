#include "spoolflow/recording/clock_follower.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "spoolflow/numerics/median.hpp"
#include "spoolflow/recording/channels/recording_error.hpp"

namespace spoolflow::recording {
namespace {

constexpr std::size_t fetched_samples = 4096;
constexpr std::size_t steps_for_median = 2000;
constexpr double longest_gap_steps = 10;
constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

/// The step is that of the stretch of most samples.
ClockSpan even_span(const ColumnClock& clock, const std::string& file) {
  const std::vector<EvenStretch>& stretches = clock.wave.stretches();
  ClockSpan out{clock.wave.at(0), clock.wave.at(clock.samples > 0 ? clock.samples - 1 : 0), 0};
  std::uint64_t most = 0;
  for (std::size_t k = 0; k < stretches.size(); ++k) {
    const std::uint64_t end = k + 1 < stretches.size() ? stretches[k + 1].first : clock.samples;
    if (end - stretches[k].first >= most) most = end - stretches[k].first, out.step_s = stretches[k].step_s;
    if (k == 0) continue;
    const double last_s = clock.wave.at(stretches[k].first - 1);
    if (stretches[k].begin_s >= last_s) continue;
    throw RecordingError(fmt::format(
        "{}, sample {}: time runs backwards, from {:.9g} to {:.9g} s, as wf_start_time and wf_start_offset state it; "
        "cut the recording there",
        file, stretches[k].first + 1, last_s, stretches[k].begin_s));
  }
  return out;
}

}  // namespace

ClockSpan span_of(SampleTable& table, const ColumnClock& clock, TimeScale scale, const std::string& file) {
  if (!clock.time) return even_span(clock, file);
  const std::string& name = table.columns()[*clock.time].name;
  table.select({*clock.time});
  std::vector<double> block(fetched_samples), steps;
  double* const into = block.data();
  ClockSpan out;
  double last = no_value;
  for (std::size_t rows = table.read({&into, 1}, fetched_samples); rows > 0;
       rows = table.read({&into, 1}, fetched_samples)) {
    for (std::size_t row = 0; row < rows; ++row) {
      const double time_s = scale.gain * block[row] + scale.offset;
      if (std::isnan(time_s)) {
        throw RecordingError(
            fmt::format("{}, '{}': the time stamp is missing; every sample needs one", table.place(row), name));
      }
      if (time_s < last) {
        throw RecordingError(fmt::format(
            "{}, '{}': time runs backwards, from {:.9g} to {:.9g} s, so that its columns cannot be brought onto the "
            "time of the current; cut the recording there, or sort it by time",
            table.place(row), name, last, time_s));
      }
      if (std::isnan(last)) out.begin_s = time_s;
      if (time_s > last && steps.size() < steps_for_median) steps.push_back(time_s - last);
      out.end_s = last = time_s;
    }
  }
  if (std::isnan(last)) throw RecordingError(fmt::format("{}: '{}' holds no time stamps", file, name));
  if (!steps.empty()) out.step_s = numerics::median(std::move(steps));
  return out;
}

ClockFollower::ClockFollower(std::unique_ptr<SampleTable> table, std::vector<std::size_t> columns,
                             const ColumnClock& clock, TimeScale scale, const ClockSpan& span, double window_s)
    : table_(std::move(table)),
      clock_(clock),
      scale_(scale),
      span_(span),
      window_s_(window_s),
      values_(columns.size()) {
  if (clock.time) columns.push_back(*clock.time);
  table_->select(columns);
  block_.assign(columns.size(), std::vector<double>(fetched_samples));
}

/// Adds a block; false at the end.
bool ClockFollower::fetch() {
  std::vector<double*> into;
  for (std::vector<double>& column : block_) into.push_back(column.data());
  const std::size_t rows = table_->read(into, fetched_samples);
  for (std::size_t row = 0; row < rows; ++row) {
    times_s_.push_back(clock_.time ? scale_.gain * block_.back()[row] + scale_.offset : clock_.wave.at(read_ + row));
    for (std::size_t k = 0; k < values_.size(); ++k) values_[k].push_back(block_[k][row]);
  }
  read_ += rows;
  return rows > 0;
}

/// All but the sample from which the line to that time begins.
void ClockFollower::forget_before(double time_s) {
  while (times_s_.size() > 1 && times_s_[1] <= time_s) {
    times_s_.pop_front();
    for (std::deque<double>& column : values_) column.pop_front();
  }
}

/// On the line between samples `after` - 1 and `after`.
double ClockFollower::at(std::size_t column, double time_s, std::size_t after) const {
  const double begin_s = times_s_[after - 1], step_s = times_s_[after] - begin_s;
  if (time_s == times_s_[after] || step_s == 0) return values_[column][after];
  if (time_s == begin_s) return values_[column][after - 1];
  if (step_s > longest_gap_steps * span_.step_s) return no_value;
  const double share = (time_s - begin_s) / step_s;
  return (1 - share) * values_[column][after - 1] + share * values_[column][after];
}

void ClockFollower::values(double time_s, std::span<double> out) {
  std::ranges::fill(out, no_value);
  if (!(time_s >= span_.begin_s && time_s <= span_.end_s)) return;
  const double from_s = std::max(span_.begin_s, time_s - window_s_ / 2);
  const double to_s = std::min(span_.end_s, time_s + window_s_ / 2);
  while (times_s_.empty() || times_s_.back() < to_s) {
    forget_before(from_s);
    if (!fetch()) break;
  }
  forget_before(from_s);
  if (times_s_.size() < 2) {
    for (std::size_t k = 0; k < out.size() && !times_s_.empty(); ++k) {
      if (times_s_.front() == time_s) out[k] = values_[k].front();
    }
    return;
  }
  for (std::size_t k = 0; k < out.size(); ++k) {
    double sum = 0, width_s = 0;
    for (std::size_t after = 1; after < times_s_.size() && times_s_[after - 1] <= to_s; ++after) {
      const double begin_s = std::max(from_s, times_s_[after - 1]), end_s = std::min(to_s, times_s_[after]);
      if (end_s < begin_s) continue;
      if (from_s == to_s) {
        out[k] = at(k, time_s, after);
        break;
      }
      const double mean = at(k, (begin_s + end_s) / 2, after);
      if (std::isnan(mean)) continue;
      sum += mean * (end_s - begin_s), width_s += end_s - begin_s;
    }
    if (width_s > 0) out[k] = sum / width_s;
  }
}

}  // namespace spoolflow::recording
