#pragma once
/// What the source of a valve has done wrong since the store began: it goes on counting at each start.
#include <cstdint>
#include <map>

#include "addons/live/history/sqlite.hpp"

namespace spoolflow::live {

/// Of samples, but for pieces that are none and for the times that a sender began.
struct SourceCounts {
  std::uint64_t dropped = 0, lost = 0, repeated = 0, unreadable = 0, connections = 0;

  bool operator==(const SourceCounts&) const = default;
};

/// Where there is none yet; stores of programs that kept no counts get it, too.
void make_source_count_table(Database& database);
/// By the valves' numbers.
[[nodiscard]] std::map<std::int64_t, SourceCounts> kept_source_counts(Database& database);
/// In the transaction of the caller.
void keep_source_counts(Database& database, std::int64_t valve, const SourceCounts& counts);

}  // namespace spoolflow::live
