#pragma once
/// Which files of an exported folder the next export may replace.
#include <filesystem>
#include <string>
#include <vector>

#include "spoolflow/export/cpp_folder.hpp"

namespace spoolflow::exports {

/// Files of an earlier export into that folder may be replaced as long as nobody changed them; whatever else bears a
/// name that is needed is somebody's work. Why the files must not be written there; empty where they may.
[[nodiscard]] std::string why_not_to_overwrite(const std::filesystem::path& folder,
                                               const std::vector<ExportedFile>& files);

}  // namespace spoolflow::exports
