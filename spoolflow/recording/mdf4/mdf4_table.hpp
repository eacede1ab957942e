#pragma once
#include <filesystem>
#include <memory>

#include "spoolflow/recording/files/vector_table.hpp"

namespace spoolflow::recording {

/// An MDF 4 file: channels of numbers by their name, as `group/channel` where several groups hold some; converted as
/// the file says, invalid samples missing. The time of a group is a column like any other, called `time` for whoever
/// looks for it. Throws RecordingError where the file is damaged.
[[nodiscard]] std::unique_ptr<VectorTable> open_mdf4_table(const std::filesystem::path& file);

}  // namespace spoolflow::recording
