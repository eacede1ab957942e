#include "spoolflow/recording/recording.hpp"

#include <fmt/format.h>

#include "spoolflow/recording/channels/recording_error.hpp"

namespace spoolflow::recording {

std::span<const double> Recording::operator[](Channel channel) const {
  if (!has(channel)) {
    throw RecordingError(
        fmt::format("{}: has no channel \"{}\"; name its column in a channel map", file.string(), name(channel)));
  }
  return columns[static_cast<std::size_t>(channel)];
}

}  // namespace spoolflow::recording
