#pragma once
/// Block means of a run whose length is not known beforehand, in bounded memory.
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "spoolflow/plausibility/clipped_channel.hpp"
#include "spoolflow/plausibility/position_resolution.hpp"
#include "spoolflow/plausibility/signals/motion_trace.hpp"
#include "spoolflow/plausibility/signals/sample_grid.hpp"
#include "spoolflow/plausibility/steady_lines.hpp"
#include "spoolflow/recording/reader.hpp"
#include "spoolflow/recording/recording.hpp"

namespace spoolflow::plausibility {

/// A stretch of time without samples.
struct Gaps {
  std::uint64_t count = 0;
  double longest_s = 0, longest_from_s = 0;
};
/// So long a step between two samples is a gap [s].
inline constexpr double least_gap_s = 1;

/// As block_means(), but that samples missing among others of a block are left out of its mean. Pressure difference and
/// flow are named as there.
class RunMeans {
 public:
  RunMeans() = default;
  explicit RunMeans(const recording::Recording& run) { take({run.columns, run.size()}); }
  void take(const recording::SampleBlock& block);
  [[nodiscard]] recording::Recording means(const std::filesystem::path& file) const;
  [[nodiscard]] const Gaps& gaps() const { return gaps_; }
  [[nodiscard]] const PositionResolution& position_resolution() const { return position_resolution_; }
  [[nodiscard]] const SteadyLines& steady_lines() const { return steady_lines_; }
  [[nodiscard]] const ClippedChannels& clipped() const { return clipped_; }
  [[nodiscard]] const SampleGrid& sample_grid() const { return sample_grid_; }
  [[nodiscard]] const MotionTrace& motion() const { return motion_; }

 private:
  struct Column {
    std::vector<double> sums;
    std::vector<std::uint64_t> counts;
  };
  void halve();
  void find_gaps(const std::vector<double>& times_s);

  std::array<Column, recording::channel_count> columns_;
  std::size_t blocks_ = 0;
  std::uint64_t width_ = 1;   ///< samples in a full block
  std::uint64_t filled_ = 0;  ///< of the last block
  Gaps gaps_;
  PositionResolution position_resolution_;
  SteadyLines steady_lines_;
  ClippedChannels clipped_;
  MotionTrace motion_;
  SampleGrid sample_grid_;
  double last_s_ = 0;
  bool begun_ = false;
};

}  // namespace spoolflow::plausibility
