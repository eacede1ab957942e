#pragma once
/// Blocks of samples (addons/live/blocks/block.hpp) that a site keeps until the fleet has committed them. To the store
/// they are bytes with a number.
#include <cstdint>
#include <string>
#include <vector>

#include "addons/live/history/sqlite.hpp"

namespace spoolflow::live {

struct OutboxBlock {
  std::uint64_t number = 0;  ///< of the valve, from 1
  std::vector<std::uint8_t> bytes{};
};

/// How far the blocks of a valve have come.
struct OutboxPosition {
  std::string valve{};
  std::uint64_t session = 0;  ///< of the store: ms since 1970-01-01 UTC when it first kept a block; 0: it has none
  std::uint64_t number = 0;   ///< of the newest block; 0: none yet
  std::uint64_t covered = 0;  ///< the fleet has committed all up to this one
};

/// Where there is none yet; stores of programs that knew no fleet get it, too.
void make_outbox_tables(Database& database);
/// Of all valves that ever had a block.
[[nodiscard]] std::vector<OutboxPosition> outbox_positions(Database& database);
/// The session of this store; `wall_ms` where it has none yet.
[[nodiscard]] std::uint64_t outbox_session(Database& database, std::int64_t wall_ms);

/// In the transaction of the caller.
void keep_blocks(Database& database, const OutboxPosition& position, const std::vector<OutboxBlock>& blocks);
/// In the transaction of the caller: the fleet has these.
void drop_covered(Database& database, const std::string& valve, std::uint64_t covered);
/// Deletes the oldest blocks, of all valves alike, until the others have at most so many bytes. Returns how many.
std::int64_t drop_oldest_blocks(Database& database, double largest_MB);

/// The first blocks that are kept behind the number `after`, at most so many, ascending: what was given up counts for
/// nothing. The database may be open to read alone.
[[nodiscard]] std::vector<OutboxBlock> blocks_of(Database& database, const std::string& valve, std::uint64_t after,
                                                 std::uint64_t most);

}  // namespace spoolflow::live
