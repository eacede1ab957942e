#pragma once
/// What the commands say of how a recording was read.
#include <string>
#include <vector>

#include "spoolflow/recording/reader.hpp"

namespace spoolflow::apps {

/// How many of the samples have the time of the one before; of most of them also why they may.
[[nodiscard]] std::string repeated_times_text(std::uint64_t repeated, std::uint64_t samples);

/// What was met while reading, a line each; empty where all was well.
[[nodiscard]] std::vector<std::string> notes_text(const recording::ReadNotes& notes, const std::string& file);

}  // namespace spoolflow::apps
