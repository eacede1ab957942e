#pragma once
/// What the fleet keeps of one valve: what a worker adds in one transaction, and from what another goes on.
#include <cstdint>
#include <string>
#include <vector>

#include "addons/live/history/store.hpp"

namespace spoolflow::fleet {

/// Which block of a valve: numbers begin at 1 in each session.
struct BlockPlace {
  std::uint64_t session = 0;  ///< 0: none came yet
  std::uint64_t number = 0;
};

struct SecondRow {
  BlockPlace block;
  std::int64_t wall_ms = 0;  ///< of the site's clock, as all of them
  live::Summary summary{};
};

struct IndicatorRow {
  BlockPlace block;
  std::int64_t wall_ms = 0;
  live::KeptIndicator indicator;
};

struct ModelChange {
  BlockPlace from;  ///< in force from this block on
  std::string sha256;
};

/// Where a valve stands behind its last block; with it another worker goes on bit for bit.
struct ValvePosition {
  BlockPlace block{};
  std::int64_t wall_ms = 0;
  std::int64_t minute = 0;  ///< of the source's clock, in which indicators were kept last
  std::string model_sha256{};
  std::string alarm_waits{};  ///< since when causes stand or are away; text of the worker's own
  live::KeptState state{};    ///< `valve` is its name; `session` and `next` are those of the block that comes next
};

struct ValveRows {
  ValvePosition position;
  std::vector<SecondRow> seconds{};
  std::vector<IndicatorRow> indicators{};
  std::vector<live::Event> events{};
  std::vector<live::Alarm> alarms{};  ///< raised or changed; their ids ascend in each valve
  std::vector<ModelChange> models{};
};

/// Somebody has seen an alarm. It takes effect behind the block at which a worker takes it.
struct Acknowledgement {
  std::string valve;
  std::int64_t alarm = 0;
  std::int64_t wall_ms = 0;  ///< of the page's clock
  std::string by{};          ///< the account
  BlockPlace taken{};        ///< behind that block
};

/// A block of which nothing is made, as it came: for an operator to look at.
struct SetAsideBlock {
  std::string subject{};       ///< on which it came, in printable characters
  std::string valve{};         ///< empty: its header names none
  BlockPlace block{};          ///< session 0: its header has none
  std::uint64_t sequence = 0;  ///< in the stream
  std::string reason{};        ///< continues "the block is"
  std::string bytes{};
};
/// Of one transaction: the first few as they came, and how many there were.
struct SetAsideBlocks {
  static constexpr std::size_t most_kept = 32;
  std::vector<SetAsideBlock> kept{};
  std::int64_t count = 0;
};

struct KeptValve {
  ValvePosition position;
  std::vector<live::Alarm> alarms{};  ///< not cleared, and the one with the largest id
};

}  // namespace spoolflow::fleet
