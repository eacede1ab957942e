#pragma once
/// What is kept of the valves of one partition, read at its taking and added to in single transactions, each of which
/// fails where the partition is another's by now.
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

#include "addons/fleet/store/partitions.hpp"
#include "addons/fleet/store/rows.hpp"

namespace spoolflow::fleet {

/// From where the stream is read on; a hint only: blocks that come twice are dropped by their numbers.
struct StreamPosition {
  std::int64_t created_ns = 0;  ///< of that stream
  std::uint64_t sequence = 0;
};

/// The server refuses what a valve's blocks gave, as it would each time: nothing of the transaction is kept.
struct ValveRefused : std::runtime_error {
  ValveRefused(std::string name, const std::string& why) : std::runtime_error(why), valve(std::move(name)) {}
  std::string valve;
};

class PartitionStore {
 public:
  /// Keeps a reference to the session. Each commit renews the lease by `lease_s`: who commits is alive.
  PartitionStore(Session& session, const Claim& claim, double lease_s)
      : session_(session), claim_(claim), lease_s_(lease_s) {}

  [[nodiscard]] std::vector<KeptValve> read();
  [[nodiscard]] StreamPosition stream_position();
  /// One transaction: all of it, or nothing. Throws Fenced, ServerAway, ServerRefuses or ValveRefused; start again,
  /// with read(), behind any of them, as it is not known what is kept. Returns which of the kept ones set aside are
  /// there for the first time.
  std::vector<std::size_t> commit(const std::vector<ValveRows>& valves, const std::vector<Acknowledgement>& taken,
                                  const SetAsideBlocks& aside, const StreamPosition& stream);
  /// Those of the partition's alarms that no commit has taken.
  [[nodiscard]] std::vector<Acknowledgement> acknowledgements();

  /// The model file of that hash, as it came; nothing where the fleet has none.
  [[nodiscard]] std::optional<std::vector<std::uint8_t>> model(const std::string& sha256);
  void keep_model(const std::string& sha256, std::span<const std::uint8_t> content);

 private:
  /// What the store has of a valve's state, against which changes are written.
  struct OlderState {
    std::int64_t number = 0;  ///< of the valve
    std::string layout{};
    std::vector<std::byte> bytes{};
    std::size_t written = 0, least = 0, wasted = 0;  ///< as in live::Store
  };
  OlderState& known(const std::string& valve);
  void put_state(OlderState& older, const live::KeptState& state);
  void put_rows(std::int64_t number, const ValveRows& valve);
  void put_alarm(const live::Alarm& alarm);
  std::vector<std::size_t> put_aside(const SetAsideBlocks& aside);
  void put_position(std::int64_t number, const ValvePosition& position);
  [[nodiscard]] std::vector<live::Alarm> alarms_of(const std::string& valve);

  Session& session_;
  Claim claim_;
  double lease_s_;
  std::map<std::string, OlderState> states_;
};

}  // namespace spoolflow::fleet
