#include "addons/live/history/store.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "addons/live/history/preparation.hpp"
#include "addons/live/history/state_change.hpp"

namespace spoolflow::live {
namespace {

/// Rows move to the table of each valve's after so many commits, and where there is a gap longer than this.
constexpr int rows_move_every = 60;
constexpr std::int64_t longest_gap_ms = 60'000;
/// A state of more bytes is none that a valve has.
constexpr std::int64_t largest_state = 16 << 20;

StateChanges changes_in(Database& database) {
  Statement all(database, "SELECT of_valves FROM state_change");
  return all.next() ? parted(all.bytes(0)) : StateChanges();
}

}  // namespace

struct Store::Statements {
  /// What the store has of a valve's state, against which changes are written.
  struct OlderState {
    std::string layout;
    std::vector<std::byte> bytes;
    std::size_t written = 0;  ///< bytes that it took
    std::size_t least = 0;    ///< bytes of the smallest change since
    std::size_t wasted = 0;   ///< bytes of all changes since beyond that
  };

  Statement second, indicator, event, state, state_change, older_state, new_valve;
  std::map<std::string, std::int64_t> numbers;  ///< of valves
  std::map<std::int64_t, OlderState> states;    ///< as written since the program began
  StateChanges changes;                         ///< against the older states in the file
  std::map<std::int64_t, SourceCounts> counts;  ///< as written
  int rows_moved_before = rows_move_every;      ///< commits; those of the program before go at once

  explicit Statements(Database& database)
      : second(database, "INSERT INTO newest_second VALUES(?,?,?,?,?,?,?,?,?,?,?,?)"),
        indicator(database, "INSERT INTO indicator VALUES(?,?,?,?,?,?,?,?)"),
        event(database,
              "INSERT INTO event(wall_ms,valve,time_s,kind,text,acknowledged_ms,run_ms) VALUES(?,?,?,?,?,?,?)"),
        state(database, "INSERT OR REPLACE INTO state VALUES(?,?,?,?,?)"),
        state_change(database, "INSERT OR REPLACE INTO state_change VALUES(1,?)"),
        older_state(database, "INSERT OR REPLACE INTO older_state VALUES(?,?,?,?)"),
        new_valve(database, "INSERT INTO valve(id) VALUES(?)") {
    read(database);
  }
  /// What is in the file.
  void read(Database& database) {
    states.clear();
    changes = changes_in(database);
    counts = kept_source_counts(database);
    numbers.clear();
    Statement known(database, "SELECT id, number FROM valve");
    while (known.next()) numbers.emplace(known.text(0), known.integer(1));
  }
};

Store::Store(const std::string& path) : path_(path) {
  open();
}

void Store::open() {
  lock_.emplace(path_);
  path_ = real_name(path_);
  auto opened = std::make_unique<Database>(path_, Database::Access::write);
  prepare(*opened);
  if (on_disk_) opened->run("PRAGMA synchronous=FULL");
  statements_ = std::make_unique<Statements>(*opened);
  run_time_.emplace(*opened);
  database_ = std::move(opened);
  watch_.emplace(*database_);
}

void Store::close() {
  if (database_) database_->leave_log();
  statements_.reset();
  database_.reset();
  run_time_.reset();
  watch_.reset();
  lock_.reset();
}

Database& Store::open_one() {
  if (!database_) throw StoreError(fmt::format("{}: could not be opened again; nothing is kept", path_));
  return *database_;
}

Store::~Store() = default;

std::vector<KeptState> Store::states() {
  std::vector<KeptState> out;
  const StateChanges changes = changes_in(*database_);
  const std::map<std::int64_t, SourceCounts> counts = kept_source_counts(*database_);
  Statement each(*database_,
                 "SELECT id, session, next, samples, energy_J, layout, bytes, content, number FROM state "
                 "JOIN older_state USING(valve) JOIN valve ON state.valve = valve.number");
  while (each.next()) {
    KeptState kept{.valve = each.text(0),
                   .session = static_cast<std::uint64_t>(each.integer(1)),
                   .next = static_cast<std::uint64_t>(each.integer(2)),
                   .samples = static_cast<std::uint64_t>(each.integer(3)),
                   .energy_J = each.real(4),
                   .layout = each.text(5)};
    const std::int64_t length = each.integer(6);
    const auto change = changes.find(each.integer(8));
    if (const auto counted = counts.find(each.integer(8)); counted != counts.end()) kept.counts = counted->second;
    bool whole = length >= 0 && length <= largest_state && change != changes.end();
    if (whole) {
      kept.bytes.resize(static_cast<std::size_t>(length));
      whole = apply_change(each.bytes(7), kept.bytes) && apply_change(change->second, kept.bytes);
    }
    if (!whole) kept.layout = "damaged";  // sensor and monitor start again, counts go on
    out.push_back(std::move(kept));
  }
  return out;
}

std::int64_t Store::number_of(const std::string& valve) {
  const auto found = statements_->numbers.find(valve);
  if (found != statements_->numbers.end()) return found->second;
  statements_->new_valve.put(std::string_view(valve)).run();
  return statements_->numbers[valve] = database_->number("SELECT last_insert_rowid()");
}

void Store::put_row(std::int64_t valve, const RowTime& at, const Summary& row) {
  Statement& to = statements_->second;
  to.put(valve).put(at.wall_ms).put(row.time_s).put(row.samples);
  to.put(row.flow_min_m3_per_s).put(row.flow_mean_m3_per_s).put(row.flow_max_m3_per_s);
  to.put(row.lower_min_m3_per_s).put(row.upper_max_m3_per_s).put(row.energy_J).put(std::int64_t{row.status});
  to.put(at.run_ms).run();
}

/// The change against the older state; that one again once all that was written beyond the smallest change is more than
/// it takes itself.
void Store::put_state(std::int64_t valve, const KeptState& state) {
  Statements::OlderState& older = statements_->states[valve];
  std::vector<std::byte>& change = statements_->changes[valve];
  const bool comparable = older.written > 0 && older.layout == state.layout && older.bytes.size() == state.bytes.size();
  if (comparable) {
    change = state_change(older.bytes, state.bytes);
    older.least = older.least == 0 ? change.size() : std::min(older.least, change.size());
    older.wasted += change.size() - older.least;
  }
  if (!comparable || older.wasted > older.written) {
    const std::vector<std::byte> content = state_change({}, state.bytes);
    older = {.layout = state.layout, .bytes = state.bytes, .written = content.size() + 1};
    change.clear();
    statements_->older_state.put(valve).put(std::string_view(state.layout));
    statements_->older_state.put(static_cast<std::int64_t>(state.bytes.size())).put(std::span(content)).run();
  }
  Statement& to = statements_->state;
  to.put(valve).put(static_cast<std::int64_t>(state.session)).put(static_cast<std::int64_t>(state.next));
  to.put(static_cast<std::int64_t>(state.samples)).put(state.energy_J).run();
}

void Store::move_rows() {
  live::move_rows(*database_);
  statements_->rows_moved_before = 0;
}

void Store::commit_all(const RowTime& at, const std::vector<ValveCommit>& valves, std::vector<Event>& events,
                       const std::vector<Alarm>& alarms, const ReportedTexts& reported) {
  Transaction whole(*database_);
  Statements& to = *statements_;
  const RowTime& before = run_time_->newest();
  const bool is_apart =
      std::abs(at.wall_ms - before.wall_ms) > longest_gap_ms || at.run_ms - before.run_ms > longest_gap_ms;
  if (to.rows_moved_before++ >= rows_move_every || is_apart) move_rows();
  bool any = false, has_rows = false, has_indicators = false;
  for (const ValveCommit& valve : valves) {
    const std::int64_t number = number_of(valve.state.valve);
    keep_blocks(*database_, {valve.state.valve, valve.outbox_session}, valve.blocks);
    if (valve.since_last.samples > 0) put_row(number, at, valve.since_last);
    has_rows = has_rows || valve.since_last.samples > 0;
    has_indicators = has_indicators || !valve.indicators.empty();
    for (const KeptIndicator& one : valve.indicators) {
      to.indicator.put(number).put(at.wall_ms).put(std::string_view(one.name)).put(one.value).put(one.uncertainty_95);
      to.indicator.put(one.baseline).put(std::string_view(one.state)).put(at.run_ms).run();
    }
    if (SourceCounts& counts = to.counts[number]; counts != valve.state.counts) {
      counts = valve.state.counts;
      keep_source_counts(*database_, number, counts);
    }
    if (valve.since_last.samples == 0 && valve.indicators.empty() && !needs_states_) continue;  // nothing has changed
    put_state(number, valve.state);
    any = true;
  }
  if (has_indicators && !has_rows) keep_stretch(*database_, at);
  for (Event& event : events) {
    if (event.id != 0) continue;
    to.event.put(event.wall_ms).put(std::string_view(event.valve)).put(event.time_s).put(std::string_view(event.kind));
    to.event.put(std::string_view(event.text)).put(event.acknowledged_ms).put(at.run_ms).run();
    event.id = database_->number("SELECT last_insert_rowid()");
  }
  keep_alarms(*database_, alarms, at.run_ms);
  keep_reports(*database_, reported);
  if (any) {
    const std::vector<std::byte> all = joined(to.changes);
    to.state_change.put(std::span(all)).run();
  }
  whole.commit();
}

void Store::commit(const Instant& now, const std::vector<ValveCommit>& valves, std::vector<Event>& events,
                   const std::vector<Alarm>& alarms, const ReportedTexts& reported) {
  (void)open_one();
  try {
    const RowTime at = run_time_->next(*database_, now);
    commit_all(at, valves, events, alarms, reported);
    run_time_->kept(at, now);
    needs_states_ = false;
  } catch (const std::exception& error) {
    damaged_ = damaged_ || dynamic_cast<const StoreDamage*>(&error) != nullptr;
    for (Event& event : events) event.id = 0;
    statements_->read(*database_);  // what is in memory was taken back
    throw;
  }
}

void Store::cover(const std::vector<OutboxPosition>& covered) {
  Transaction whole(open_one());
  for (const OutboxPosition& one : covered) drop_covered(*database_, one.valve, one.covered);
  whole.commit();
}

std::int64_t Store::keep_recording(const KeptRecording& recording) {
  Statement add(open_one(), "INSERT INTO recording(wall_ms,valve,why,csv,run_ms) VALUES(?,?,?,?,?)");
  add.put(recording.wall_ms).put(std::string_view(recording.valve)).put(std::string_view(recording.why));
  add.put(std::as_bytes(std::span(recording.csv))).put(newest().run_ms).run();
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

void Store::retain(const Retention& retention) {
  {
    Transaction whole(open_one());
    move_rows();
    whole.commit();
  }
  delete_old(*database_, retention, newest().run_ms);
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
