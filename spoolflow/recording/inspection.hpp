#pragma once
/// What a recording holds, before anything is made of it.
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "spoolflow/recording/inspected_clock.hpp"
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

/// A column of the file, and what it is taken for.
struct InspectedColumn {
  std::string name, unit;          ///< unit: as the file states it; empty where it does not
  double lowest, highest;          ///< in that unit; NaN without numbers
  std::optional<Channel> channel;  ///< nothing: not used
  std::string why;                 ///< of a channel how that is known, else what the column could be
  bool guessed = false;            ///< by its numbers, or by a word of its name
  bool times_others = false;       ///< it holds the times of other columns
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
  ChannelMap proposal;                     ///< by names, then by numbers; estimate takes it once its units are known
  std::map<Channel, std::string> remarks;  ///< of channels of the proposal that are guesses
  std::vector<InspectedColumn> columns;    ///< in the file's order; none where a channel map was given
  std::vector<InspectedClock> clocks;      ///< where columns are of several; else none
  std::map<std::string, InfiniteSamples> infinite;  ///< of each column that was looked at and has some
  std::string resampled;                            ///< what was brought onto the time of the current (ReadNotes)
  std::vector<Channel> missing;                     ///< that every sensor needs, and the proposal lacks
  std::vector<Channel> helpful;                     ///< likewise, without which the answer is worse or cannot be judged
};

/// "-" is standard input, of which a copy is kept on disk while it is read more than once. Reads the channels that
/// `options` or the headers name; memory does not grow with the recording. Where no channel is recognised, only
/// contents and proposal are filled. An infinite number is a missing sample here, and said. Throws RecordingError as
/// reading does.
[[nodiscard]] Inspection inspect(const std::filesystem::path& file, const ReadOptions& options,
                                 const std::function<void(std::optional<double>, std::uint64_t)>& progress);

}  // namespace spoolflow::recording
