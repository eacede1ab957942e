#pragma once
#include <filesystem>
#include <memory>

#include "spoolflow/recording/files/vector_table.hpp"

namespace spoolflow::recording {

/// A TDMS file: channels of numbers as `group/channel`, scaled as the file says (linear, polynomial, table), with
/// `unit_string` as unit; wf_increment, wf_start_offset and wf_start_time say how they were sampled. Times count in
/// seconds from the earliest one of the file. Throws RecordingError where the file is damaged.
[[nodiscard]] std::unique_ptr<VectorTable> open_tdms_table(const std::filesystem::path& file);

}  // namespace spoolflow::recording
