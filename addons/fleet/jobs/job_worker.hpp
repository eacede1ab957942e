#pragma once
/// The side of batch work that does it: takes pieces of its own program, each in a process of its own, and keeps what
/// comes of them.
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "addons/fleet/jobs/piece.hpp"
#include "addons/fleet/store/job_table.hpp"

namespace spoolflow::fleet {

struct JobSettings {
  unsigned processes = 0;   ///< pieces at a time of one worker
  double keep_hours = 168;  ///< results that nobody waits for any more
  double largest_MB = 500;  ///< of one file that a piece reads or writes
};

struct JobWorkerParts {
  std::string connection;  ///< to PostgreSQL
  std::string owner;       ///< the worker's name in its table
  std::string program;     ///< piece_program()
  double lease_s = 4;
  JobSettings settings{};
  /// Writes a file and makes the folder that it stands in. Throws std::runtime_error.
  std::function<void(const std::filesystem::path&, const std::string&)> write{};
};

class JobWorker {
 public:
  /// A server that is away is waited for. `report` is called with what is worth a line, from any thread.
  JobWorker(JobWorkerParts parts, std::function<void(const std::string&)> report);
  /// What is at work is killed and left to others.
  void stop();

 private:
  void work(const std::stop_token& stop, bool cleans_up);
  bool take_one(std::unique_ptr<Session>& session, const std::stop_token& stop);
  bool goes_on(std::unique_ptr<Session>& session, const std::string& key, const std::stop_token& stop);
  void finish(Session& session, const std::string& key, const std::filesystem::path& folder);

  JobWorkerParts parts_;
  std::function<void(const std::string&)> report_;
  std::vector<std::jthread> threads_;  ///< last: they use the others
};

/// What is said of a file that may not go to the fleet, or come from it.
[[nodiscard]] std::string too_large(const std::string& file, double bytes_MB, const JobSettings& settings);

/// Names, in a piece's folder, of the piece and of what came of it.
inline constexpr const char* piece_name = "piece.json";
inline constexpr const char* outcome_name = "outcome.json";

}  // namespace spoolflow::fleet
