#include "addons/live/history/preparation.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <fmt/format.h>

#include "addons/live/history/alarm_table.hpp"
#include "addons/live/history/outbox_table.hpp"

namespace spoolflow::live {
namespace {

constexpr std::int64_t application_id = 0x53464C57;  // "SFLW"

constexpr const char* schema = R"(
CREATE TABLE valve(number INTEGER PRIMARY KEY, id TEXT NOT NULL UNIQUE);
CREATE TABLE second_of_valve(
  valve INTEGER NOT NULL, wall_ms INTEGER NOT NULL, time_s REAL, samples INTEGER NOT NULL,
  flow_min REAL, flow_mean REAL, flow_max REAL, lower_min REAL, upper_max REAL, energy_J REAL, status INTEGER NOT NULL,
  PRIMARY KEY(valve, wall_ms)) WITHOUT ROWID;
CREATE TABLE newest_second(
  valve INTEGER NOT NULL, wall_ms INTEGER NOT NULL, time_s REAL, samples INTEGER NOT NULL,
  flow_min REAL, flow_mean REAL, flow_max REAL, lower_min REAL, upper_max REAL, energy_J REAL, status INTEGER NOT NULL,
  PRIMARY KEY(wall_ms, valve)) WITHOUT ROWID;
CREATE VIEW second AS SELECT * FROM second_of_valve UNION ALL SELECT * FROM newest_second;
CREATE TABLE indicator(
  valve INTEGER NOT NULL, wall_ms INTEGER NOT NULL, name TEXT NOT NULL, value REAL, uncertainty_95 REAL, baseline REAL,
  state TEXT NOT NULL, PRIMARY KEY(valve, wall_ms, name)) WITHOUT ROWID;
CREATE TABLE event(
  id INTEGER PRIMARY KEY AUTOINCREMENT, wall_ms INTEGER NOT NULL, valve TEXT NOT NULL, time_s REAL, kind TEXT NOT NULL,
  text TEXT NOT NULL, acknowledged_ms INTEGER NOT NULL DEFAULT 0);
CREATE TABLE recording(
  id INTEGER PRIMARY KEY AUTOINCREMENT, wall_ms INTEGER NOT NULL, valve TEXT NOT NULL, why TEXT NOT NULL,
  csv BLOB NOT NULL);
CREATE TABLE state(
  valve INTEGER PRIMARY KEY, session INTEGER NOT NULL, next INTEGER NOT NULL, samples INTEGER NOT NULL,
  energy_J REAL NOT NULL);
CREATE TABLE state_change(one INTEGER PRIMARY KEY CHECK(one = 1), of_valves BLOB NOT NULL);
CREATE TABLE older_state(valve INTEGER PRIMARY KEY, layout TEXT NOT NULL, bytes INTEGER NOT NULL, content BLOB NOT NULL);
)";

/// Pages of the log before its newest are written to their places; most are written over many times until then.
constexpr int checkpoint_pages = 16000;
}  // namespace

int only_program(const std::string& path) {
  const std::string name = path + ".lock";
  const int descriptor = ::open(name.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor < 0) {
    throw StoreError(fmt::format("{}: its folder does not exist or may not be written to; name another", path));
  }
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    ::close(descriptor);
    throw StoreError(fmt::format("{}: another spoolflow live is running on it; end that or name another store", path));
  }
  return descriptor;
}

void check_version(Database& database) {
  const std::string& path = database.path();
  if (database.number("PRAGMA application_id") != application_id) {
    throw StoreError(fmt::format("{}: is a database of another program; name another file", path));
  }
  const std::int64_t version = database.number("PRAGMA user_version");
  if (version != store_version) {
    throw StoreError(
        fmt::format("{}: is a store of version {}, this program knows version {}; use the program that "
                    "made it, or name another file",
                    path, version, store_version));
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
    database.run(
        fmt::format("{} PRAGMA application_id={}; PRAGMA user_version={};", schema, application_id, store_version));
    whole.commit();
  }
  make_alarm_tables(database);
  make_outbox_tables(database);
  // The whole of a large one would take minutes; damage is then told where it is met.
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
