#include "addons/live/history/outbox_table.hpp"

#include <algorithm>

namespace spoolflow::live {

void make_outbox_tables(Database& database) {
  database.run(R"(
CREATE TABLE IF NOT EXISTS outbox(
  id INTEGER PRIMARY KEY AUTOINCREMENT, valve TEXT NOT NULL, number INTEGER NOT NULL, block BLOB NOT NULL,
  UNIQUE(valve, number));
CREATE TABLE IF NOT EXISTS outbox_position(
  valve TEXT PRIMARY KEY, session INTEGER NOT NULL, number INTEGER NOT NULL, covered INTEGER NOT NULL) WITHOUT ROWID;
)");
}

std::vector<OutboxPosition> outbox_positions(Database& database) {
  std::vector<OutboxPosition> out;
  Statement each(database, "SELECT valve, session, number, covered FROM outbox_position ORDER BY valve");
  while (each.next()) {
    out.push_back({each.text(0), static_cast<std::uint64_t>(each.integer(1)),
                   static_cast<std::uint64_t>(each.integer(2)), static_cast<std::uint64_t>(each.integer(3))});
  }
  return out;
}

std::uint64_t outbox_session(Database& database, std::int64_t wall_ms) {
  const std::int64_t session = database.number("SELECT coalesce(max(session), 0) FROM outbox_position");
  return static_cast<std::uint64_t>(session > 0 ? session : wall_ms);
}

void keep_blocks(Database& database, const OutboxPosition& position, const std::vector<OutboxBlock>& blocks) {
  if (blocks.empty()) return;
  Statement add(database, "INSERT INTO outbox(valve, number, block) VALUES(?,?,?)");
  for (const OutboxBlock& block : blocks) {
    add.put(std::string_view(position.valve)).put(static_cast<std::int64_t>(block.number));
    add.put(std::as_bytes(std::span(block.bytes))).run();
  }
  Statement at(database,
               "INSERT INTO outbox_position VALUES(?,?,?,0) "
               "ON CONFLICT(valve) DO UPDATE SET session = excluded.session, number = excluded.number");
  at.put(std::string_view(position.valve)).put(static_cast<std::int64_t>(position.session));
  at.put(static_cast<std::int64_t>(blocks.back().number)).run();
}

void drop_covered(Database& database, const std::string& valve, std::uint64_t covered) {
  Statement blocks(database, "DELETE FROM outbox WHERE valve = ? AND number <= ?");
  blocks.put(std::string_view(valve)).put(static_cast<std::int64_t>(covered)).run();
  Statement at(database, "UPDATE outbox_position SET covered = max(covered, ?) WHERE valve = ?");
  at.put(static_cast<std::int64_t>(covered)).put(std::string_view(valve)).run();
}

std::int64_t drop_oldest_blocks(Database& database, double largest_MB) {
  std::int64_t dropped = 0;
  // By their order of arrival; a thousand at a time, so that the sum is not taken for each.
  while (1e-6 * static_cast<double>(database.number("SELECT coalesce(sum(length(block)), 0) FROM outbox")) >
         largest_MB) {
    const std::int64_t before = database.number("SELECT count(*) FROM outbox");
    database.run("DELETE FROM outbox WHERE id IN (SELECT id FROM outbox ORDER BY id LIMIT 1000)");
    dropped += before - database.number("SELECT count(*) FROM outbox");
  }
  return dropped;
}

std::vector<OutboxBlock> blocks_of(Database& database, const std::string& valve, std::uint64_t after,
                                   std::uint64_t most) {
  std::vector<OutboxBlock> out;
  Statement each(database, "SELECT number, block FROM outbox WHERE valve = ? AND number > ? ORDER BY number LIMIT ?");
  each.put(std::string_view(valve)).put(static_cast<std::int64_t>(after)).put(static_cast<std::int64_t>(most));
  while (each.next()) {
    OutboxBlock block{.number = static_cast<std::uint64_t>(each.integer(0))};
    const std::span<const std::byte> bytes = each.bytes(1);
    block.bytes.resize(bytes.size());
    std::transform(bytes.begin(), bytes.end(), block.bytes.begin(), [](std::byte b) { return std::uint8_t(b); });
    out.push_back(std::move(block));
  }
  return out;
}

}  // namespace spoolflow::live
