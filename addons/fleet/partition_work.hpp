#pragma once
/// One partition at work: blocks from the stream, in their order through their valves, committed together, reported to
/// the sites as covered. Begins from what is kept, and ends by an exception where that is not its own any more.
#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <stop_token>
#include <string>
#include <vector>

#include "addons/fleet/models.hpp"
#include "addons/fleet/set_aside.hpp"
#include "addons/fleet/settings.hpp"
#include "addons/fleet/store/partition_store.hpp"
#include "addons/fleet/suspects.hpp"
#include "addons/fleet/transport/nats.hpp"
#include "addons/fleet/valve_line.hpp"

namespace spoolflow::fleet {

/// What all partitions of a worker share.
struct WorkerParts {
  const FleetSettings& settings;
  SharedSettings shared;
  std::string program;  ///< name and version
  Connection& nats;
  Models& models;
  std::function<void(const std::string&)> report;  ///< what is worth a line, from any thread
};

class PartitionWork {
 public:
  /// Reads what is kept. Throws ServerAway or ServerRefuses.
  PartitionWork(WorkerParts parts, const Claim& claim);
  /// Until it is stopped; then all that came is committed. `moved` is called again and again, as long as nothing hangs.
  /// Throws Fenced, ServerAway, ServerRefuses, TransportError.
  void run(const std::stop_token& stop, const std::function<void()>& moved);

 private:
  using Clock = std::chrono::steady_clock;
  /// A block that came before its turn.
  struct Early {
    Block block;
    std::size_t bytes;  ///< about
  };
  struct Place {
    Place(const std::string& valve, const std::string& program, const live::AlarmDelays& delays)
        : line(valve, program, delays) {}
    ValveLine line;
    std::map<std::pair<std::uint64_t, std::uint64_t>, Early> early{};  ///< by session and number
    Clock::time_point asked{};                                         ///< for what is missing
    bool gathered = false;                                             ///< its next block is
    std::size_t uncommitted = 0;                                       ///< blocks
  };
  /// A block whose turn has come.
  struct Gathered {
    Place* at;
    Block block;
    live::SharedModel model;
  };
  Place& place(const std::string& valve);
  void restore();
  void restart(const ValveRefused& why);
  [[nodiscard]] std::optional<Block> whole_block(const Message& message);
  StreamPlace stream_there();
  void open_stream();
  bool fetch();
  void take(const Message& message);
  bool gather(Place& place, Block& block);
  void keep_early(Place& place, Block&& block);
  void gather_early(Place& place);
  void work();
  [[nodiscard]] std::optional<live::SharedModel> model(const std::string& sha256);
  void take_models();
  void ask(const std::string& valve, Place& place, const std::string& what);
  void ask_for_missing();
  void commit();
  void publish_coverage(bool all);

  WorkerParts parts_;
  Claim claim_;
  Session session_;
  PartitionStore store_;
  std::map<std::string, Place> places_;
  std::vector<Gathered> gathered_;     ///< of each valve one
  std::set<std::string> to_publish_;   ///< valves whose coverage is to be published to their sites
  std::set<std::string> kept_models_;  ///< hashes of those that the store is known to have
  std::optional<Puller> puller_;
  SetAside set_aside_;
  Suspects suspects_;
  int silent_readers_ = 0;  ///< in a row
  Subscription models_;
  StreamPosition stream_;
  std::optional<Clock::time_point> gone_since_{};  ///< the stream; nothing while it is there
  std::size_t uncommitted_ = 0;                    ///< blocks
  std::size_t early_bytes_ = 0;                    ///< of all valves
  Clock::time_point committed_ = Clock::now(), published_ = Clock::now();
};

}  // namespace spoolflow::fleet
