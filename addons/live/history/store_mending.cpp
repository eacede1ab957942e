/// What a store does where its file was deleted, replaced or damaged while the program works on it.
#include <filesystem>
#include <utility>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "addons/live/history/preparation.hpp"
#include "addons/live/history/store.hpp"

namespace spoolflow::live {
namespace {

namespace fs = std::filesystem;

/// For names of files that are set aside.
std::string stamp_of(std::int64_t wall_ms) {
  return fmt::format("{:%Y%m%dT%H%M%SZ}", fmt::gmtime(static_cast<std::time_t>(wall_ms / 1000)));
}

/// Throws StoreError.
void rename(const std::string& from, const std::string& to) {
  std::error_code failed;
  fs::rename(from, to, failed);
  if (!failed || failed == std::errc::no_such_file_or_directory) return;
  throw StoreError(
      fmt::format("{}: cannot be renamed to {} ({}); check the folder and its rights", from, to, failed.message()));
}

void remove(const std::string& path) {
  std::error_code ignored;
  fs::remove(path, ignored);
}

void remove_log(const std::string& store) {
  remove(store + "-wal");
  remove(store + "-shm");
}

}  // namespace

void Store::keep_on_disk() {
  on_disk_ = true;
  open_one().run("PRAGMA synchronous=FULL");
}

void Store::keep_again(const std::vector<Event>& events, const std::vector<Alarm>& alarms,
                       const ReportedTexts& reported) {
  needs_states_ = true;
  Transaction whole(open_one());
  Statement add(
      *database_,
      "INSERT OR IGNORE INTO event(id,wall_ms,valve,time_s,kind,text,acknowledged_ms,run_ms) VALUES(?,?,?,?,?,?,?,?)");
  for (const Event& event : events) {
    if (event.id == 0) continue;  // it comes with the next commit
    add.put(event.id).put(event.wall_ms).put(std::string_view(event.valve)).put(event.time_s);
    add.put(std::string_view(event.kind))
        .put(std::string_view(event.text))
        .put(event.acknowledged_ms)
        .put(newest().run_ms)
        .run();
  }
  keep_alarms(*database_, alarms, newest().run_ms);
  keep_reports(*database_, reported);
  whole.commit();
}

std::string Store::look_after(std::int64_t wall_ms) {
  if (!database_) {
    open();
    needs_states_ = true;
    return fmt::format("{}: can be used again", path_);
  }
  const bool damaged = std::exchange(damaged_, false);
  switch (watch_->look(*database_)) {
    case FileWatch::Found::gone:
      return rewrite();
    case FileWatch::Found::replaced:
      return go_on_in_another(stamp_of(wall_ms));
    case FileWatch::Found::damaged:
      return set_aside(stamp_of(wall_ms));
    case FileWatch::Found::log_gone:
      open_one().run("PRAGMA wal_checkpoint(TRUNCATE)");
      close();
      open();
      needs_states_ = true;
      return fmt::format(
          "{0}-wal was deleted or replaced while spoolflow live worked on it; what it held is saved in {0}", path_);
    case FileWatch::Found::same:
      break;
  }
  return damaged ? set_aside(stamp_of(wall_ms)) : std::string();
}

/// All that the open file holds.
void Store::save_as(const std::string& path) {
  remove(path);
  try {
    Statement save(open_one(), "VACUUM INTO ?");
    save.put(std::string_view(path)).run();
  } catch (...) {
    remove(path);
    throw;
  }
}

std::string Store::rewrite() {
  const std::string fresh = path_ + ".mended";
  try {
    save_as(fresh);
  } catch (const StoreDamage&) {  // deleted after it was damaged: there is nothing to set aside
    close();
    remove_log(path_);
    needs_states_ = true;
    open();
    return fmt::format(
        "{}: was damaged and deleted while spoolflow live worked on it; a new store goes on with the states of all "
        "valves, alarms and the last events",
        path_);
  }
  close();
  remove_log(path_);  // of the deleted file: it must not be taken for the new one's
  rename(fresh, path_);
  needs_states_ = true;
  open();
  return fmt::format(
      "{}: was deleted while spoolflow live worked on it; it is written again with all that it held. To begin with an "
      "empty store end the program first",
      path_);
}

std::string Store::go_on_in_another(const std::string& stamp) {
  const std::string aside = fmt::format("{}.replaced-{}", path_, stamp);
  save_as(aside);
  const bool has_log = watch_->has_log(*database_);
  close();
  if (has_log) {  // of the file that was there before: it must not be taken for this one's
    remove_log(path_);
  }
  needs_states_ = true;
  open();
  return fmt::format(
      "{0}: another file was put in its place while spoolflow live worked on it; what it held is saved as {1}, and "
      "what comes is kept in the one that is there now",
      path_, aside);
}

std::string Store::set_aside(const std::string& stamp) {
  const std::string aside = fmt::format("{}.damaged-{}", path_, stamp);
  close();
  needs_states_ = true;
  rename(path_, aside);
  rename(path_ + "-wal", aside + "-wal");
  remove(path_ + "-shm");
  open();
  return fmt::format(
      "{0}: was cut off or overwritten while spoolflow live worked on it; it is set aside as {1}, from which `sqlite3 "
      "{1} "
      ".recover` may read what is left, and a new store goes on with the states of all valves, alarms and the last "
      "events",
      path_, aside);
}

}  // namespace spoolflow::live
