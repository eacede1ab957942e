#include "addons/live/history/preparation.hpp"

#include <fmt/format.h>

#include "addons/live/history/alarm_table.hpp"
#include "addons/live/history/outbox_table.hpp"
#include "addons/live/history/reported_table.hpp"
#include "addons/live/history/source_count_table.hpp"

namespace spoolflow::live {
namespace {

constexpr std::int64_t application_id = 0x53464C57;  // "SFLW"

constexpr const char* schema = R"(
CREATE TABLE valve(number INTEGER PRIMARY KEY, id TEXT NOT NULL UNIQUE);
CREATE TABLE second_of_valve(
  valve INTEGER NOT NULL, wall_ms INTEGER NOT NULL, time_s REAL, samples INTEGER NOT NULL,
  flow_min REAL, flow_mean REAL, flow_max REAL, lower_min REAL, upper_max REAL, energy_J REAL, status INTEGER NOT NULL,
  run_ms INTEGER NOT NULL DEFAULT 0, PRIMARY KEY(valve, wall_ms)) WITHOUT ROWID;
CREATE TABLE newest_second(
  valve INTEGER NOT NULL, wall_ms INTEGER NOT NULL, time_s REAL, samples INTEGER NOT NULL,
  flow_min REAL, flow_mean REAL, flow_max REAL, lower_min REAL, upper_max REAL, energy_J REAL, status INTEGER NOT NULL,
  run_ms INTEGER NOT NULL DEFAULT 0, PRIMARY KEY(wall_ms, valve)) WITHOUT ROWID;
CREATE VIEW second AS SELECT * FROM second_of_valve UNION ALL SELECT * FROM newest_second;
CREATE TABLE indicator(
  valve INTEGER NOT NULL, wall_ms INTEGER NOT NULL, name TEXT NOT NULL, value REAL, uncertainty_95 REAL, baseline REAL,
  state TEXT NOT NULL, run_ms INTEGER NOT NULL DEFAULT 0, PRIMARY KEY(valve, wall_ms, name)) WITHOUT ROWID;
CREATE TABLE event(
  id INTEGER PRIMARY KEY AUTOINCREMENT, wall_ms INTEGER NOT NULL, valve TEXT NOT NULL, time_s REAL, kind TEXT NOT NULL,
  text TEXT NOT NULL, acknowledged_ms INTEGER NOT NULL DEFAULT 0, run_ms INTEGER NOT NULL DEFAULT 0);
CREATE TABLE recording(
  id INTEGER PRIMARY KEY AUTOINCREMENT, wall_ms INTEGER NOT NULL, valve TEXT NOT NULL, why TEXT NOT NULL,
  csv BLOB NOT NULL, run_ms INTEGER NOT NULL DEFAULT 0);
CREATE TABLE state(
  valve INTEGER PRIMARY KEY, session INTEGER NOT NULL, next INTEGER NOT NULL, samples INTEGER NOT NULL,
  energy_J REAL NOT NULL);
CREATE TABLE state_change(one INTEGER PRIMARY KEY CHECK(one = 1), of_valves BLOB NOT NULL);
CREATE TABLE older_state(valve INTEGER PRIMARY KEY, layout TEXT NOT NULL, bytes INTEGER NOT NULL, content BLOB NOT NULL);
)";

/// Which times of day the rows up to a run time have (retention.hpp); raw samples are large, and their rows are not
/// read to see how old they are.
constexpr const char* stretches = R"(
CREATE TABLE stretch(run_ms INTEGER PRIMARY KEY, from_ms INTEGER NOT NULL, to_ms INTEGER NOT NULL);
CREATE INDEX age_of_event ON event(run_ms, wall_ms);
CREATE INDEX age_of_recording ON recording(run_ms, wall_ms);
)";

/// Pages of the log before its newest are written to their places; most are written over many times until then.
constexpr int checkpoint_pages = 16000;

std::int64_t version_of(Database& database) {
  return database.number("PRAGMA user_version");
}

/// Rows of version 2 have no run time and get none: to this program they are as old as its first start.
void bring_up_to_date(Database& database) {
  Transaction whole(database);
  for (const char* const table : {"second_of_valve", "newest_second", "indicator", "event", "recording"}) {
    database.run(fmt::format("ALTER TABLE {} ADD COLUMN run_ms INTEGER NOT NULL DEFAULT 0", table));
  }
  if (database.number("SELECT count(*) FROM pragma_table_info('alarm') WHERE name = 'run_ms'") == 0) {
    database.run("ALTER TABLE alarm ADD COLUMN run_ms INTEGER NOT NULL DEFAULT 0");
  }
  // After a clock was set back a row may lie where another is already.
  const std::string taken =
      " FROM second_of_valve AS one WHERE one.valve = newest_second.valve AND one.wall_ms = newest_second.wall_ms)";
  while (database.number("SELECT count(*) FROM newest_second WHERE EXISTS(SELECT 1" + taken) > 0) {
    database.run("UPDATE newest_second SET wall_ms = wall_ms + 1 WHERE EXISTS(SELECT 1" + taken);
  }
  database.run(
      "INSERT INTO second_of_valve SELECT * FROM newest_second ORDER BY valve, wall_ms; DELETE FROM newest_second");
  database.run(stretches);
  // By the tables' own keys, valve by valve.
  const auto of_each = [](const char* which) {
    return fmt::format(
        "SELECT (SELECT {0}(wall_ms) FROM second_of_valve AS one WHERE one.valve = number) AS at FROM valve UNION ALL "
        "SELECT (SELECT {0}(wall_ms) FROM indicator AS one WHERE one.valve = number) FROM valve",
        which);
  };
  database.run(fmt::format(
      "INSERT INTO stretch SELECT 0, (SELECT min(at) FROM ({})) AS first, (SELECT max(at) FROM ({})) AS last "
      "WHERE first IS NOT NULL",
      of_each("min"), of_each("max")));
  database.run(fmt::format("PRAGMA user_version={}", store_version));
  whole.commit();
}

}  // namespace

void check_version(Database& database) {
  const std::string& path = database.path();
  if (database.number("PRAGMA application_id") != application_id) {
    throw StoreError(fmt::format("{}: is a database of another program; name another file", path));
  }
  const std::int64_t version = version_of(database);
  if (version < oldest_store_version || version > store_version) {
    throw StoreError(
        fmt::format("{}: is a store of version {}, this program knows versions {} and {}; use the program that "
                    "made it, or name another file",
                    path, version, oldest_store_version, store_version));
  }
}

void prepare(Database& database) {
  const bool empty = database.number("SELECT count(*) FROM sqlite_master") == 0;
  if (!empty) check_version(database);
  // Many systems build SQLite to overwrite what it deletes, which doubles what is written.
  database.run(fmt::format(
      "PRAGMA journal_mode=WAL; PRAGMA synchronous=NORMAL; PRAGMA secure_delete=OFF; PRAGMA wal_autocheckpoint={}",
      checkpoint_pages));
  if (empty) {
    Transaction whole(database);
    database.run(fmt::format("{}{} PRAGMA application_id={}; PRAGMA user_version={};", schema, stretches,
                             application_id, store_version));
    whole.commit();
  }
  make_alarm_tables(database);
  make_outbox_tables(database);
  make_source_count_table(database);
  make_reported_table(database);
  if (version_of(database) < store_version) bring_up_to_date(database);
  // The whole of a large one would take minutes; damage is then reported where it is met.
  constexpr std::int64_t most_pages = 50'000;
  if (database.number("PRAGMA page_count") > most_pages) return;
  Statement check(database, "PRAGMA quick_check(1)");
  if (check.next() && check.text(0) != "ok") {
    throw StoreError(
        fmt::format("{0}: is damaged ({1}); keep a copy of it, save what can be read with `sqlite3 {0} "
                    ".recover`, and name another file",
                    database.path(), check.text(0)));
  }
}

}  // namespace spoolflow::live
