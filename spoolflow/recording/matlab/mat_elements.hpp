#pragma once
#include <filesystem>

namespace spoolflow::recording {

/// A MATLAB file of version 5 is a header of 128 bytes and a chain of elements, each with its length: the chain must
/// end where the file ends, which matio does not look at (it reads on as if zeros followed). Throws RecordingError.
/// Other versions pass.
void refuse_cut_mat_file(const std::filesystem::path& file);

}  // namespace spoolflow::recording
