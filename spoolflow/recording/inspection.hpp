#pragma once
/// What a recording holds, before anything is made of it.
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "spoolflow/recording/reader.hpp"

namespace spoolflow::recording {

struct ChannelSummary {
  Channel channel;
  double lowest, highest, mean;  ///< SI
  std::uint64_t missing;
  double clipped;  ///< share of the samples that stand at the lowest or highest value while neighbours do too
};

struct Gap {
  double from_s, to_s;
};

struct Inspection {
  FileContents contents;
  std::uint64_t samples = 0;
  double begin_s = 0, end_s = 0;
  double rate_Hz = 0;  ///< 1 / median time step
  double jitter = 0;   ///< largest deviation of a time step below three times the median, as a share of it
  std::uint64_t duplicate_times = 0;
  std::uint64_t gap_count = 0;
  std::vector<Gap> gaps;  ///< the first ten: time steps of more than three times the median
  std::vector<ChannelSummary> channels;
  ChannelMap proposal;
};

/// Reads the channels that `options` or the headers name; memory does not grow with the recording. Where no channel can
/// be told, only contents and proposal are filled. Throws RecordingError as reading does.
[[nodiscard]] Inspection inspect(const std::filesystem::path& file, const ReadOptions& options,
                                 const std::function<void(std::optional<double>, std::uint64_t)>& progress);

}  // namespace spoolflow::recording
