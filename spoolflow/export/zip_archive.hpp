#pragma once
#include <ctime>
#include <string>
#include <vector>

namespace spoolflow::exports {

struct ArchiveMember {
  std::string name;  ///< with '/' between folders
  std::string bytes;
};

/// A ZIP archive of the members, deflated, all with the same time stamp. Throws std::runtime_error where libzip fails.
[[nodiscard]] std::string zip_archive(const std::vector<ArchiveMember>& members, std::time_t time);

}  // namespace spoolflow::exports
