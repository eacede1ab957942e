#pragma once
/// A worker: takes its share of the partitions and works on each in a thread of its own, as long as they are its own.
///
///     fleet::Worker worker(fleet::read_fleet("fleet.toml"), "spoolflow 1.2", say);
///     ...                              // it works
///     worker.stop();                   // commits, and leaves its partitions to the others
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "addons/fleet/partition_work.hpp"

namespace spoolflow::fleet {

class Worker {
 public:
  /// Servers that are away are waited for. Throws ServerRefuses, LoginError. `program`: name and version. `report` is
  /// called with what is worth a line, from any thread.
  Worker(FleetSettings settings, std::string program, std::function<void(const std::string&)> report);
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  void stop();
  [[nodiscard]] const std::string& owner() const { return owner_; }

 private:
  struct Task;
  void keep_share(const std::stop_token& stop);
  void learn_settings(Session& session);
  void report_nats_away();
  [[nodiscard]] std::vector<Claim> standing();
  void spread(Session& session);
  void begin(const Claim& claim);
  void see_off(Session& session);

  FleetSettings settings_;
  std::string program_, owner_;
  std::function<void(const std::string&)> report_;
  std::unique_ptr<Connection> nats_;
  SharedSettings shared_;  ///< no partitions: not known yet
  Models models_;
  std::string reported_;  ///< what was reported last of a server that is away; of the keeper, once it is at work
  int away_ = 0;          ///< times that NATS was found away, one after another
  std::map<std::int64_t, std::unique_ptr<Task>> tasks_;  ///< by partition
  /// Asked to end; to be waited for by nobody who renews leases.
  std::vector<std::unique_ptr<Task>> leaving_;
  std::jthread keeper_;  ///< last: it uses the others
};

}  // namespace spoolflow::fleet
