#pragma once
/// What a drawing of spoolflow/ must show: no folder too full to be taken in, and no arrow back up.
#include <filesystem>
#include <string>
#include <vector>

namespace spoolflow::architecture {

inline constexpr std::size_t most_subjects = 25;

/// A subject is a header with its source. One line a folder that holds more than `most_subjects` of them itself.
[[nodiscard]] std::vector<std::string> full_folders(const std::filesystem::path& root);

/// One line a circle: subjects each of which includes the next, and the last the first.
[[nodiscard]] std::vector<std::string> circles(const std::filesystem::path& root);

}  // namespace spoolflow::architecture
