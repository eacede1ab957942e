#include "spoolflow/live/store/store.hpp"

#include <algorithm>
#include <fcntl.h>
#include <filesystem>
#include <map>
#include <sys/file.h>
#include <unistd.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace spoolflow::live {
namespace {

constexpr std::int64_t application_id = 0x53464C57;  // "SFLW"

constexpr const char* schema = R"(
CREATE TABLE valve(number INTEGER PRIMARY KEY, id TEXT NOT NULL UNIQUE);
CREATE TABLE second(
  valve INTEGER NOT NULL, wall_ms INTEGER NOT NULL, time_s REAL, samples INTEGER NOT NULL,
  flow_min REAL, flow_mean REAL, flow_max REAL, lower_min REAL, upper_max REAL, energy_J REAL, status INTEGER NOT NULL,
  PRIMARY KEY(valve, wall_ms)) WITHOUT ROWID;
CREATE TABLE indicator(
  valve INTEGER NOT NULL, wall_ms INTEGER NOT NULL, name TEXT NOT NULL, value REAL, uncertainty_95 REAL, baseline REAL,
  state TEXT NOT NULL, PRIMARY KEY(valve, name, wall_ms)) WITHOUT ROWID;
CREATE TABLE event(
  id INTEGER PRIMARY KEY AUTOINCREMENT, wall_ms INTEGER NOT NULL, valve TEXT NOT NULL, time_s REAL, kind TEXT NOT NULL,
  text TEXT NOT NULL, acknowledged_ms INTEGER NOT NULL DEFAULT 0);
CREATE TABLE recording(
  id INTEGER PRIMARY KEY AUTOINCREMENT, wall_ms INTEGER NOT NULL, valve TEXT NOT NULL, why TEXT NOT NULL,
  csv BLOB NOT NULL);
CREATE TABLE state(
  valve INTEGER PRIMARY KEY, session INTEGER NOT NULL, next INTEGER NOT NULL, samples INTEGER NOT NULL,
  energy_J REAL NOT NULL, layout TEXT NOT NULL, sensor BLOB NOT NULL, watch BLOB NOT NULL);
)";

/// Held as long as the program runs; SQLite's own locks let several programs write by turns.
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

/// Of a file that is there: whether this program can use it.
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
  database.run("PRAGMA journal_mode=WAL; PRAGMA synchronous=NORMAL");
  if (empty) {
    Transaction whole(database);
    database.run(
        fmt::format("{} PRAGMA application_id={}; PRAGMA user_version={};", schema, application_id, store_version));
    whole.commit();
  }
  make_alarm_tables(database);
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

std::vector<std::byte> copied(std::span<const std::byte> bytes) {
  return {bytes.begin(), bytes.end()};
}

}  // namespace

struct Store::Statements {
  Statement second, indicator, event, state, new_valve;
  std::map<std::string, std::int64_t> numbers;  ///< of valves

  explicit Statements(Database& database)
      : second(database, "INSERT OR REPLACE INTO second VALUES(?,?,?,?,?,?,?,?,?,?,?)"),
        indicator(database, "INSERT OR REPLACE INTO indicator VALUES(?,?,?,?,?,?,?)"),
        event(database, "INSERT INTO event(wall_ms,valve,time_s,kind,text,acknowledged_ms) VALUES(?,?,?,?,?,?)"),
        state(database, "INSERT OR REPLACE INTO state VALUES(?,?,?,?,?,?,?,?)"),
        new_valve(database, "INSERT INTO valve(id) VALUES(?)") {
    Statement known(database, "SELECT id, number FROM valve");
    while (known.next()) numbers.emplace(known.text(0), known.integer(1));
  }
};

Store::Store(const std::string& path) : lock_(only_program(path)) {
  try {
    database_ = std::make_unique<Database>(path, Database::Access::write);
    prepare(*database_);
    statements_ = std::make_unique<Statements>(*database_);
  } catch (...) {
    ::close(lock_);
    throw;
  }
}

Store::~Store() {
  statements_.reset();
  database_.reset();
  ::close(lock_);
}

std::vector<KeptState> Store::states() {
  std::vector<KeptState> out;
  Statement each(*database_,
                 "SELECT id, session, next, samples, energy_J, layout, sensor, watch FROM state JOIN valve ON "
                 "state.valve = valve.number");
  while (each.next()) {
    out.push_back({each.text(0), static_cast<std::uint64_t>(each.integer(1)),
                   static_cast<std::uint64_t>(each.integer(2)), static_cast<std::uint64_t>(each.integer(3)),
                   each.real(4), each.text(5), copied(each.bytes(6)), copied(each.bytes(7))});
  }
  return out;
}

std::int64_t Store::number_of(const std::string& valve) {
  const auto found = statements_->numbers.find(valve);
  if (found != statements_->numbers.end()) return found->second;
  statements_->new_valve.put(std::string_view(valve)).run();
  return statements_->numbers[valve] = database_->number("SELECT last_insert_rowid()");
}

void Store::commit(std::int64_t wall_ms, const std::vector<ValveCommit>& valves, std::vector<Event>& events,
                   const std::vector<Alarm>& alarms) {
  Transaction whole(*database_);
  Statements& to = *statements_;
  for (const ValveCommit& valve : valves) {
    const KeptState& state = valve.state;
    const Summary& row = valve.since_last;
    const std::int64_t number = number_of(state.valve);
    if (row.samples > 0) {
      to.second.put(number).put(wall_ms).put(row.time_s).put(row.samples);
      to.second.put(row.flow_min_m3_per_s).put(row.flow_mean_m3_per_s).put(row.flow_max_m3_per_s);
      to.second.put(row.lower_min_m3_per_s).put(row.upper_max_m3_per_s).put(row.energy_J);
      to.second.put(std::int64_t{row.status}).run();
    }
    for (const KeptIndicator& one : valve.indicators) {
      to.indicator.put(number).put(wall_ms).put(std::string_view(one.name)).put(one.value).put(one.uncertainty_95);
      to.indicator.put(one.baseline).put(std::string_view(one.state)).run();
    }
    if (row.samples == 0 && valve.indicators.empty()) continue;  // nothing has changed since it was written
    to.state.put(number).put(static_cast<std::int64_t>(state.session)).put(static_cast<std::int64_t>(state.next));
    to.state.put(static_cast<std::int64_t>(state.samples)).put(state.energy_J).put(std::string_view(state.layout));
    to.state.put(std::span(state.sensor)).put(std::span(state.watch)).run();
  }
  for (Event& event : events) {
    if (event.id != 0) continue;
    to.event.put(event.wall_ms).put(std::string_view(event.valve)).put(event.time_s).put(std::string_view(event.kind));
    to.event.put(std::string_view(event.text)).put(event.acknowledged_ms).run();
    event.id = database_->number("SELECT last_insert_rowid()");
  }
  keep_alarms(*database_, alarms);
  try {
    whole.commit();
  } catch (...) {
    for (Event& event : events) event.id = 0;
    throw;
  }
}

std::int64_t Store::keep_recording(const KeptRecording& recording) {
  Statement add(*database_, "INSERT INTO recording(wall_ms,valve,why,csv) VALUES(?,?,?,?)");
  add.put(recording.wall_ms).put(std::string_view(recording.valve)).put(std::string_view(recording.why));
  add.put(std::as_bytes(std::span(recording.csv))).run();
  return database_->number("SELECT last_insert_rowid()");
}

std::vector<Event> Store::events(int most) {
  std::vector<Event> out;
  Statement each(*database_,
                 "SELECT id, wall_ms, valve, time_s, kind, text, acknowledged_ms FROM event ORDER BY id DESC LIMIT ?");
  each.put(std::int64_t{most});
  while (each.next()) {
    out.push_back(
        {each.integer(0), each.integer(1), each.text(2), each.real(3), each.text(4), each.text(5), each.integer(6)});
  }
  std::reverse(out.begin(), out.end());
  return out;
}

void Store::retain(std::int64_t wall_ms, const Retention& retention) {
  const auto delete_before = [&](std::int64_t oldest_ms) {
    Transaction whole(*database_);
    // By the tables' own keys: each valve's rows are in order of time.
    Statement seconds(*database_, "DELETE FROM second WHERE valve = ? AND wall_ms < ?");
    for (const auto& entry : statements_->numbers) seconds.put(entry.second).put(oldest_ms).run();
    Statement(*database_, "DELETE FROM indicator WHERE wall_ms < ?").put(oldest_ms).run();
    Statement(*database_, "DELETE FROM recording WHERE wall_ms < ?").put(oldest_ms).run();
    Statement(*database_, "DELETE FROM event WHERE wall_ms < ?").put(oldest_ms).run();
    delete_alarms(*database_, oldest_ms);
    whole.commit();
  };
  delete_before(wall_ms - static_cast<std::int64_t>(retention.days * 86400e3));
  const auto used_MB = [&] {
    const std::int64_t pages = database_->number("PRAGMA page_count") - database_->number("PRAGMA freelist_count");
    return 1e-6 * static_cast<double>(pages) * static_cast<double>(database_->number("PRAGMA page_size"));
  };
  const auto extreme = [&](const char* which) {  // of the rows' times; by the table's key, valve by valve
    std::optional<std::int64_t> out;
    Statement one(*database_, fmt::format("SELECT {}(wall_ms) FROM second WHERE valve = ?", which));
    for (const auto& entry : statements_->numbers) {
      one.put(entry.second);
      if (!one.next()) continue;
      const std::int64_t time_ms = one.integer(0);
      while (one.next()) {
      }
      if (time_ms == 0) continue;  // no rows
      const bool smallest = std::string_view(which) == "min";
      out = !out ? time_ms : smallest ? std::min(*out, time_ms) : std::max(*out, time_ms);
    }
    return out.value_or(0);
  };
  constexpr int most_rounds = 20;  // the next time comes in a minute
  for (int round = 0; round < most_rounds && used_MB() > retention.largest_MB; ++round) {
    const std::int64_t oldest_ms = extreme("min"), newest_ms = extreme("max");
    if (oldest_ms >= newest_ms) return;
    delete_before(oldest_ms + std::max<std::int64_t>(1, (newest_ms - oldest_ms) / 20));
  }
}

Database open_store_to_read(const std::string& path) {
  if (!std::filesystem::exists(path)) throw StoreError(fmt::format("{}: there is no such file", path));
  Database database(path, Database::Access::read);
  check_version(database);
  return database;
}

std::vector<KeptRecording> list_recordings(const std::string& path, int most) {
  Database database = open_store_to_read(path);
  std::vector<KeptRecording> out;
  Statement each(database, "SELECT id, wall_ms, valve, why FROM recording ORDER BY id DESC LIMIT ?");
  each.put(std::int64_t{most});
  while (each.next()) out.push_back({each.integer(0), each.integer(1), each.text(2), each.text(3), {}});
  return out;
}

std::optional<KeptRecording> read_recording(const std::string& path, std::int64_t id) {
  Database database = open_store_to_read(path);
  Statement one(database, "SELECT id, wall_ms, valve, why, csv FROM recording WHERE id = ?");
  one.put(id);
  if (!one.next()) return std::nullopt;
  return KeptRecording{one.integer(0), one.integer(1), one.text(2), one.text(3), one.text(4)};
}

void read_history(const std::string& path, const std::string& valve, std::int64_t from_ms, std::int64_t to_ms,
                  const std::function<void(const HistoryRow&)>& each) {
  Database database = open_store_to_read(path);
  std::vector<std::string> known;
  std::optional<std::int64_t> number;
  Statement valves(database, "SELECT id, number FROM valve ORDER BY id");
  while (valves.next()) {
    known.push_back(valves.text(0));
    if (known.back() == valve) number = valves.integer(1);
  }
  if (!number) {
    throw StoreError(fmt::format("{}: knows no valve '{}'; it knows: {}", path, valve, fmt::join(known, ", ")));
  }
  Statement rows(database,
                 "SELECT wall_ms, samples, time_s, flow_min, flow_mean, flow_max, lower_min, upper_max, energy_J, "
                 "status FROM second WHERE valve = ? AND wall_ms >= ? AND wall_ms < ? ORDER BY wall_ms");
  rows.put(*number).put(from_ms).put(to_ms);
  while (rows.next()) {
    each({rows.integer(0),
          {rows.integer(1), rows.real(2), rows.real(3), rows.real(4), rows.real(5), rows.real(6), rows.real(7),
           rows.real(8), static_cast<std::uint32_t>(rows.integer(9))}});
  }
}

}  // namespace spoolflow::live
