#pragma once
/// A whole recording in memory, in SI units; for calibration and validation. Long files are streamed instead
/// (reader.hpp).
#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "spoolflow/recording/channels/channel.hpp"

namespace spoolflow::recording {

/// Equally long columns, one a channel; an empty column is an absent channel. A missing sample is NaN.
struct Recording {
  std::filesystem::path file;
  std::array<std::vector<double>, channel_count> columns;
  std::string resampled{};  ///< what was brought onto the time of the current (ReadNotes)

  [[nodiscard]] bool has(Channel channel) const { return !columns[static_cast<std::size_t>(channel)].empty(); }
  /// The channel's samples in SI units. Throws RecordingError naming file and channel when absent.
  [[nodiscard]] std::span<const double> operator[](Channel channel) const;
  /// Empty where the channel is absent.
  [[nodiscard]] const std::vector<double>& column(Channel channel) const {
    return columns[static_cast<std::size_t>(channel)];
  }
  [[nodiscard]] std::vector<double>& column(Channel channel) { return columns[static_cast<std::size_t>(channel)]; }
  [[nodiscard]] std::size_t size() const { return columns[static_cast<std::size_t>(Channel::time)].size(); }
};

}  // namespace spoolflow::recording
