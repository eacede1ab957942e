#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>

#include "spoolflow/recording/files/vector_table.hpp"

namespace spoolflow::recording {

/// Opens a file in a sandboxed process, which `open` needs no more of than to open the file itself.
/// VectorTable::look() is called behind it.
using OpenVectors = std::unique_ptr<VectorTable> (*)(const std::filesystem::path&);

/// A table whose file is opened and read by a child process with limits of memory and time that go with the file's size
/// (reading_limits); its numbers come through shared memory, a block ahead of whoever reads them. Throws RecordingError
/// with the child's own words, and where the child crashes or runs into its limits. `text_is_missing`: as
/// VectorTable::take_text_as_missing().
[[nodiscard]] std::unique_ptr<SampleTable> open_confined(const std::filesystem::path& file, std::uint64_t file_bytes,
                                                         OpenVectors open, bool text_is_missing = false);

}  // namespace spoolflow::recording
