#pragma once
/// Which worker takes which partition: rows with an epoch that each taking raises, and a lease that its owner renews,
/// by the server's clock.
#include <optional>
#include <string>
#include <vector>

#include "addons/fleet/store/postgresql.hpp"

namespace spoolflow::fleet {

struct Claim {
  std::int64_t partition = 0;
  std::int64_t epoch = 0;  ///< what it was raised to; a worker with an older one has lost the partition
};

/// The partition is another's by now: what was computed since the last transaction is worthless.
struct Fenced : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Spread {
  std::vector<Claim>
      held;  ///< this worker's, the lease renewed here or by a commit that is under way; none that stands
  std::int64_t workers = 1;  ///< that are alive, this one included
};

/// A server that takes longer for a statement of a worker has lost it: more than it may wait for a lock.
inline constexpr std::chrono::seconds worker_patience{20};

/// This worker lives on for `lease_s`, and so do its leases but those of partitions that stand. `owner` is of one start
/// of one program.
[[nodiscard]] Spread renew(Session& session, const std::string& owner, double lease_s,
                           const std::vector<Claim>& standing = {});
/// Up to so many that nobody holds.
[[nodiscard]] std::vector<Claim> claim(Session& session, const std::string& owner, double lease_s, std::int64_t most);
/// One of this worker's own, with another epoch: to start again with it. Nothing where another has it by now.
[[nodiscard]] std::optional<Claim> claim_again(Session& session, const std::string& owner, std::int64_t partition);
/// For others to take at once; without effect where another has it already.
void release(Session& session, const Claim& claim);
/// This worker ends.
void leave(Session& session, const std::string& owner);

struct PartitionStatus {
  std::int64_t number, epoch, valves, blocks;
  std::string owner;       ///< empty: nobody
  double lease_s;          ///< that is left; <= 0: none
  double behind_s;         ///< since the last commit of a valve; NaN: none yet
  std::int64_t set_aside;  ///< blocks of which nothing was made, those that came again included
};
[[nodiscard]] std::vector<PartitionStatus> partition_status(Session& session);

}  // namespace spoolflow::fleet
