#include "spoolflow/plausibility/run_means.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "spoolflow/plausibility/block_means.hpp"

namespace spoolflow::plausibility {
namespace {

using recording::Channel;

constexpr std::size_t most_blocks = 4000;

/// Where at least half of a block's samples are numbers.
double mean(double sum, std::uint64_t count, std::uint64_t width) {
  return 2 * count >= width && count > 0 ? sum / static_cast<double>(count) : std::numeric_limits<double>::quiet_NaN();
}

/// Of those that are numbers.
struct Sum {
  double value = 0;
  std::uint64_t count = 0;
};
Sum sum_of(std::span<const double> values) {
  double sum = 0;
  std::uint64_t count = 0;
  for (const double value : values) {
    const bool usable = std::isfinite(value);
    sum += usable ? value : 0;
    count += usable;
  }
  return {sum, count};
}

}  // namespace

void RunMeans::halve() {
  for (Column& column : columns_) {
    for (std::size_t k = 0; k + 1 < column.sums.size(); k += 2) {
      column.sums[k / 2] = column.sums[k] + column.sums[k + 1];
      column.counts[k / 2] = column.counts[k] + column.counts[k + 1];
    }
    column.sums.resize(column.sums.size() / 2);
    column.counts.resize(column.counts.size() / 2);
  }
  blocks_ /= 2;
  width_ *= 2;
}

void RunMeans::find_gaps(const std::vector<double>& times_s) {
  for (const double time_s : times_s) {
    if (!std::isfinite(time_s)) continue;
    const double step_s = time_s - last_s_;
    last_s_ = time_s;
    if (!std::exchange(begun_, true) || !(step_s > least_gap_s)) continue;
    ++gaps_.count;
    if (step_s <= gaps_.longest_s) continue;
    gaps_.longest_s = step_s;
    gaps_.longest_from_s = time_s - step_s;
  }
}

void RunMeans::take(const recording::SampleBlock& block) {
  for (std::size_t begin = 0; begin < block.rows;) {
    if (blocks_ == 0 || filled_ == width_) {
      if (blocks_ == most_blocks) halve();
      ++blocks_;
      filled_ = 0;
    }
    const std::size_t end = begin + std::min<std::size_t>(block.rows - begin, width_ - filled_);
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      const std::vector<double>& values = block.columns[c];
      if (values.empty()) continue;
      const Sum sum = sum_of(std::span(values).subspan(begin, end - begin));
      Column& column = columns_[c];
      column.sums.resize(blocks_, 0.0);
      column.counts.resize(blocks_, 0);
      column.sums.back() += sum.value;
      column.counts.back() += sum.count;
    }
    filled_ += end - begin;
    begin = end;
  }
  find_gaps(block.column(Channel::time));
  const std::vector<double>& time_s = block.column(Channel::time);
  position_resolution_.take(time_s, block.column(Channel::position));
  steady_lines_.position.take(time_s, block.column(Channel::position));
  clipped_.take(block.columns);
  motion_.take(block.columns);
  sample_grid_.take(block.columns);
  const bool both = !block.column(Channel::current_b).empty();
  for (const std::size_t k : {0U, 1U}) {
    const bool a = k == 1;
    const Channel coil = a ? Channel::current_a : both ? Channel::current_b : Channel::current;
    const Channel voltage = a ? Channel::voltage_a : both ? Channel::voltage_b : Channel::voltage;
    steady_lines_.current[k].take(time_s, block.column(coil));
    steady_lines_.voltage[k].take(time_s, block.column(voltage));
    double largest_A = steady_lines_.largest_current_A[k];
    for (const double current_A : block.column(coil)) largest_A = std::max(largest_A, current_A);
    steady_lines_.largest_current_A[k] = largest_A;
  }
}

recording::Recording RunMeans::means(const std::filesystem::path& file) const {
  recording::Recording out{file, {}};
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    const auto& [sums, counts] = columns_[c];
    for (std::size_t k = 0; k < sums.size(); ++k)
      out.columns[c].push_back(mean(sums[k], counts[k], k + 1 == blocks_ ? filled_ : width_));
  }
  name_alike(out);
  return out;
}

}  // namespace spoolflow::plausibility
