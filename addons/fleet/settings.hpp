#pragma once
/// FLEET.toml: where the fleet's servers are and how its workers work. Format: docs/fleet.md.
#include <filesystem>
#include <string>
#include <vector>

#include "addons/fleet/jobs/job_worker.hpp"
#include "addons/fleet/store/schema.hpp"
#include "addons/fleet/transport/nats.hpp"
#include "addons/live/page_settings.hpp"
#include "addons/live/publish_settings.hpp"

namespace spoolflow::fleet {

struct WorkerSettings {
  std::string name{};     ///< up to 32 letters, digits, '_' and '-'; empty: that of the machine
  double lease_s = 4;     ///< after which the partitions of a worker that fell silent are taken by others, 2 to 60
  double commit_s = 0.5;  ///< between two transactions of a partition, 0.05 to 10
};

struct FleetSettings {
  std::vector<std::string> servers{};  ///< of NATS
  live::NatsLogin login{};
  StreamSettings stream{};
  std::string connection{};  ///< to PostgreSQL, as libpq reads it
  WorkerSettings worker{};
  JobSettings jobs{};  ///< processes: as many as the machine has cores where the file does not say
  double raised_after_s = 2, gone_after_s = 10;  ///< of alarms; --setup keeps them for all workers
  live::PageSettings page{};                     ///< of spoolflow fleet
  std::vector<std::string> sites{};              ///< for whose senders --setup prints what they may do
};

/// Throws RecordingError or SiteError with file, line, value and remedy.
[[nodiscard]] FleetSettings read_fleet(const std::filesystem::path& file);

/// With the password read from its file. Throws LoginError where that cannot be read.
[[nodiscard]] NatsAccess access_of(const std::vector<std::string>& servers, const live::NatsLogin& login);

}  // namespace spoolflow::fleet
