#include "spoolflow/consistency/run_means.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "spoolflow/consistency/block_means.hpp"

namespace spoolflow::consistency {
namespace {

using recording::Channel;

constexpr std::size_t most_blocks = 4000;

/// Where at least half of a block's samples are numbers.
double mean(double sum, std::uint64_t count, std::uint64_t width) {
  return 2 * count >= width && count > 0 ? sum / static_cast<double>(count) : std::numeric_limits<double>::quiet_NaN();
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
      double sum = 0;
      std::uint64_t count = 0;
      for (std::size_t row = begin; row < end; ++row) {
        const bool usable = std::isfinite(values[row]);
        sum += usable ? values[row] : 0;
        count += usable;
      }
      Column& column = columns_[c];
      column.sums.resize(blocks_, 0.0);
      column.counts.resize(blocks_, 0);
      column.sums.back() += sum;
      column.counts.back() += count;
    }
    filled_ += end - begin;
    begin = end;
  }
  find_gaps(block.column(Channel::time));
}

/// How many of the blocks make one that is long enough.
std::size_t RunMeans::joined_blocks() const {
  const Column& time = columns_[static_cast<std::size_t>(Channel::time)];
  std::size_t first = 0, last = time.counts.size();
  while (first < last && time.counts[first] == 0) ++first;
  while (last > first && time.counts[last - 1] == 0) --last;
  if (last - first < 2) return 1;
  const auto time_s = [&](std::size_t k) { return time.sums[k] / static_cast<double>(time.counts[k]); };
  const double block_s = (time_s(last - 1) - time_s(first)) / static_cast<double>(last - 1 - first);
  if (!(block_s > 0)) return 1;
  return static_cast<std::size_t>(std::clamp(std::ceil(shortest_run_block_s / block_s), 1.0, double{most_blocks}));
}

recording::Recording RunMeans::means(const std::filesystem::path& file) const {
  recording::Recording out{file, {}};
  const std::size_t joined = joined_blocks();
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    const auto& [sums, counts] = columns_[c];
    for (std::size_t begin = 0; begin < sums.size(); begin += joined) {
      const std::size_t end = std::min(begin + joined, sums.size());
      double sum = 0;
      std::uint64_t count = 0;
      for (std::size_t k = begin; k < end; ++k) {
        sum += sums[k];
        count += counts[k];
      }
      const std::uint64_t width = (end - begin) * width_ - (end == blocks_ ? width_ - filled_ : 0);
      out.columns[c].push_back(mean(sum, count, width));
    }
  }
  name_alike(out);
  return out;
}

}  // namespace spoolflow::consistency
