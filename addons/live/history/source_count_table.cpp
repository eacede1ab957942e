#include "addons/live/history/source_count_table.hpp"

namespace spoolflow::live {

void make_source_count_table(Database& database) {
  database.run(R"(
CREATE TABLE IF NOT EXISTS source_count(
  valve INTEGER PRIMARY KEY, dropped INTEGER NOT NULL, lost INTEGER NOT NULL, repeated INTEGER NOT NULL,
  unreadable INTEGER NOT NULL, connections INTEGER NOT NULL);
)");
}

std::map<std::int64_t, SourceCounts> kept_source_counts(Database& database) {
  std::map<std::int64_t, SourceCounts> out;
  Statement each(database, "SELECT dropped, lost, repeated, unreadable, connections, valve FROM source_count");
  const auto number = [&each](int column) { return static_cast<std::uint64_t>(each.integer(column)); };
  while (each.next()) out[each.integer(5)] = {number(0), number(1), number(2), number(3), number(4)};
  return out;
}

void keep_source_counts(Database& database, std::int64_t valve, const SourceCounts& counts) {
  Statement one(database, "INSERT OR REPLACE INTO source_count VALUES(?,?,?,?,?,?)");
  one.put(valve);
  for (const std::uint64_t count :
       {counts.dropped, counts.lost, counts.repeated, counts.unreadable, counts.connections}) {
    one.put(static_cast<std::int64_t>(count));
  }
  one.run();
}

}  // namespace spoolflow::live
