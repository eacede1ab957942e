#pragma once
/// Pieces of batch work as rows: what commands ask for, what workers take of it, and what came of it; and the contents
/// of files by their SHA-256, in chunks. Nothing here knows what a piece does.
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "addons/fleet/store/postgresql.hpp"

namespace spoolflow::fleet {

/// How often a piece is begun before it is given up: each beginning ended with its worker or its process.
inline constexpr std::int64_t most_attempts = 3;

/// One that is there already is wanted again: it is not removed as unused for a while.
[[nodiscard]] bool has_content(Session& session, const std::string& sha256);
/// All chunks in one transaction. `chunk` gives them in their order, and none behind the last one.
void keep_content(Session& session, const std::string& sha256, std::int64_t bytes,
                  const std::function<std::optional<std::vector<std::uint8_t>>(int)>& chunk);
/// One chunk after another as it was kept; false where there is no such content.
[[nodiscard]] bool read_content(Session& session, const std::string& sha256,
                                const std::function<void(std::vector<std::uint8_t>)>& chunk);

struct AskedJob {
  std::string key;                         ///< SHA-256 of all that the result follows from
  std::string kind;                        ///< for lists
  std::string program;                     ///< whose workers may take it
  std::string manifest;                    ///< what is to be done
  std::vector<std::string> contents = {};  ///< that it reads, which are kept before
};
/// One that was asked before stays as it is, but one that failed or was given up is tried again.
void ask_job(Session& session, const AskedJob& job);
/// They are still waited for, and not removed.
void want_jobs(Session& session, const std::vector<std::string>& keys);

enum class JobState : std::uint8_t { done, failed, given_up };
struct FinishedJob {
  std::string key;
  JobState state;
  std::string outcome;  ///< of a done or failed one
};
/// Those of them that are not open or running.
[[nodiscard]] std::vector<FinishedJob> finished_jobs(Session& session, const std::vector<std::string>& keys);

struct TakenJob {
  std::string key, manifest;
};
/// The oldest that nobody works on, for `lease_s`; gives up those whose workers ended `most_attempts` times.
[[nodiscard]] std::optional<TakenJob> take_job(Session& session, const std::string& owner, const std::string& program,
                                               double lease_s);
/// False where it is not this worker's any more.
[[nodiscard]] bool renew_job(Session& session, const std::string& key, const std::string& owner, double lease_s);
/// By any worker: the result follows from the key. One that is done stays as it is.
void finish_job(Session& session, const FinishedJob& job, const std::vector<std::string>& contents);
/// It is for others to take. `ended`: its process has ended without a result; such a beginning counts.
void return_job(Session& session, const std::string& key, const std::string& owner, bool ended);
/// This worker, which is alive, takes pieces of that program.
void report_at_work(Session& session, const std::string& owner, const std::string& program);
/// Those that nobody has waited for since, and contents that no other needs.
void remove_old_jobs(Session& session, double keep_hours);

struct JobStatus {
  std::int64_t open = 0, running = 0, done = 0, failed = 0, given_up = 0;
  std::int64_t contents = 0;
  double contents_MB = 0;  ///< before they were packed
};
[[nodiscard]] JobStatus job_status(Session& session);

/// Who takes pieces.
struct Takers {
  double silent_s = 0;         ///< since one of that program was at work; infinite: none ever
  std::string other_programs;  ///< at work now, with commas between; empty: none
};
[[nodiscard]] Takers takers_of(Session& session, const std::string& program);

}  // namespace spoolflow::fleet
