#include "addons/live/history/retention.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "addons/live/history/alarm_table.hpp"

namespace spoolflow::live {
namespace {

/// Times of day that are deleted at once: the rows of a store of version 2 are one stretch of any length.
constexpr std::int64_t longest_piece_ms = 600'000;
/// Events or recordings without rows of their time.
constexpr std::int64_t most_events = 10'000;

struct Stretch {
  std::int64_t run_ms;          ///< of its newest row
  std::int64_t from_ms, to_ms;  ///< times of day of its rows
};

/// Nothing where it is the newest.
std::optional<Stretch> oldest(Database& database) {
  Statement two(database, "SELECT run_ms, from_ms, to_ms FROM stretch ORDER BY run_ms LIMIT 2");
  if (!two.next()) return std::nullopt;
  const Stretch out{two.integer(0), two.integer(1), two.integer(2)};
  if (!two.next()) return std::nullopt;
  return out;
}

/// Where the piece ends that begins with the stretch's first row.
std::int64_t end_of_piece(Database& database, const Stretch& of) {
  if (of.to_ms - of.from_ms <= longest_piece_ms) return of.to_ms;
  Statement first(database,
                  "SELECT coalesce(min((SELECT min(wall_ms) FROM second_of_valve AS one WHERE one.valve = number AND "
                  "one.wall_ms >= ?)), ?) FROM valve");
  first.put(of.from_ms).put(of.to_ms);
  return first.next() ? std::min(of.to_ms, first.integer(0) + longest_piece_ms) : of.to_ms;
}

/// With events and raw samples of its time. Returns how many rows went.
std::int64_t delete_piece(Database& database, const Stretch& of) {
  const std::int64_t before = database.number("SELECT total_changes()");
  const std::int64_t end_ms = end_of_piece(database, of);
  for (const char* const table : {"second_of_valve", "indicator"}) {
    Statement rows(database, fmt::format("DELETE FROM {} WHERE valve IN (SELECT number FROM valve) AND wall_ms >= ? "
                                         "AND wall_ms <= ? AND run_ms <= ?",
                                         table));
    rows.put(of.from_ms).put(end_ms).put(of.run_ms).run();
  }
  for (const char* const table : {"event", "recording"}) {
    Statement rows(database, fmt::format("DELETE FROM {} WHERE (run_ms, wall_ms) <= (?, ?)", table));
    rows.put(of.run_ms).put(end_ms).run();
  }
  if (end_ms < of.to_ms) {
    Statement rest(database, "UPDATE stretch SET from_ms = ? WHERE run_ms = ?");
    rest.put(end_ms + 1).put(of.run_ms).run();
  } else {
    Statement(database, "DELETE FROM stretch WHERE run_ms = ?").put(of.run_ms).run();
  }
  return database.number("SELECT total_changes()") - before;
}

/// What has no rows beside it.
void delete_alone(Database& database, std::int64_t oldest_run_ms) {
  for (const char* const table : {"event", "recording"}) {
    Statement rows(
        database,
        fmt::format("DELETE FROM {0} WHERE id IN (SELECT id FROM {0} WHERE run_ms < ? ORDER BY run_ms LIMIT ?)",
                    table));
    rows.put(oldest_run_ms).put(most_events).run();
  }
  delete_alarms(database, oldest_run_ms);
}

/// Without the blocks that wait for a fleet, which have a limit of their own.
double used_MB(Database& database, double waiting_MB) {
  const std::int64_t pages = database.number("PRAGMA page_count") - database.number("PRAGMA freelist_count");
  return 1e-6 * static_cast<double>(pages) * static_cast<double>(database.number("PRAGMA page_size")) - waiting_MB;
}

}  // namespace

void move_rows(Database& database) {
  database.run(
      "INSERT INTO stretch SELECT * FROM (SELECT max(run_ms) AS run_ms, min(wall_ms), max(wall_ms) FROM newest_second) "
      "WHERE run_ms IS NOT NULL; "
      "INSERT INTO second_of_valve SELECT * FROM newest_second ORDER BY valve, wall_ms; "
      "DELETE FROM newest_second");
}

void keep_stretch(Database& database, const RowTime& row) {
  Statement one(database, "INSERT INTO stretch VALUES(?,?,?)");
  one.put(row.run_ms).put(row.wall_ms).put(row.wall_ms).run();
}

void delete_old(Database& database, const Retention& retention, std::int64_t run_ms) {
  const std::int64_t oldest_run_ms = run_ms - static_cast<std::int64_t>(retention.days * 86400e3);
  const double waiting_MB =
      1e-6 * static_cast<double>(database.number("SELECT coalesce(sum(length(block)), 0) FROM outbox"));
  Transaction whole(database);
  bool all = false;
  for (std::int64_t rows = 0; rows < most_rows_a_pass && !all;) {
    const std::optional<Stretch> next = oldest(database);
    all = !next || (next->run_ms >= oldest_run_ms && used_MB(database, waiting_MB) <= retention.largest_MB);
    if (!all) rows += delete_piece(database, *next);
  }
  if (all) delete_alone(database, oldest_run_ms);
  whole.commit();
}

}  // namespace spoolflow::live
