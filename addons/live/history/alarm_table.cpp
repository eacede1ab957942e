#include "addons/live/history/alarm_table.hpp"

#include <fmt/format.h>

namespace spoolflow::live {

void make_alarm_tables(Database& database) {
  database.run(R"(
CREATE TABLE IF NOT EXISTS alarm(
  id INTEGER PRIMARY KEY, valve TEXT NOT NULL, cause TEXT NOT NULL, sign TEXT NOT NULL, raised_ms INTEGER NOT NULL,
  gone_ms INTEGER NOT NULL, acknowledged_ms INTEGER NOT NULL, acknowledged_by TEXT NOT NULL, times INTEGER NOT NULL,
  time_s REAL, text TEXT NOT NULL, recording INTEGER NOT NULL, run_ms INTEGER NOT NULL DEFAULT 0);
CREATE TABLE IF NOT EXISTS alarm_indicator(
  alarm INTEGER NOT NULL, place INTEGER NOT NULL, name TEXT NOT NULL, value REAL, uncertainty_95 REAL, baseline REAL,
  state TEXT NOT NULL, unit TEXT NOT NULL, PRIMARY KEY(alarm, place)) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS alarm_shelf(
  alarm INTEGER PRIMARY KEY, shelved_ms INTEGER NOT NULL, until_ms INTEGER NOT NULL, by_whom TEXT NOT NULL);
CREATE TABLE IF NOT EXISTS alarm_comment(
  alarm INTEGER NOT NULL, place INTEGER NOT NULL, wall_ms INTEGER NOT NULL, by_whom TEXT NOT NULL, text TEXT NOT NULL,
  PRIMARY KEY(alarm, place)) WITHOUT ROWID;
)");
}

namespace {

void keep_shelf_and_comments(Database& database, const Alarm& one) {
  if (one.shelved_until_ms == 0) {
    Statement(database, "DELETE FROM alarm_shelf WHERE alarm = ?").put(one.id).run();
  } else {
    Statement shelf(database, "INSERT OR REPLACE INTO alarm_shelf VALUES(?,?,?,?)");
    shelf.put(one.id).put(one.shelved_ms).put(one.shelved_until_ms).put(std::string_view(one.shelved_by)).run();
  }
  if (one.comments.empty()) return;
  Statement comment(database, "INSERT OR REPLACE INTO alarm_comment VALUES(?,?,?,?,?)");
  for (std::size_t k = 0; k < one.comments.size(); ++k) {
    const AlarmComment& each = one.comments[k];
    comment.put(one.id).put(static_cast<std::int64_t>(k)).put(each.at_ms);
    comment.put(std::string_view(each.by)).put(std::string_view(each.text)).run();
  }
}

void read_shelves_and_comments(Database& database, std::vector<Alarm>& alarms) {
  Statement shelf(database, "SELECT shelved_ms, until_ms, by_whom FROM alarm_shelf WHERE alarm = ?");
  Statement comment(database, "SELECT wall_ms, by_whom, text FROM alarm_comment WHERE alarm = ? ORDER BY place");
  for (Alarm& one : alarms) {
    shelf.put(one.id);
    while (shelf.next()) {
      one.shelved_ms = shelf.integer(0);
      one.shelved_until_ms = shelf.integer(1);
      one.shelved_by = shelf.text(2);
    }
    comment.put(one.id);
    while (comment.next()) one.comments.push_back({comment.integer(0), comment.text(1), comment.text(2)});
  }
}

}  // namespace

void keep_alarms(Database& database, const std::vector<Alarm>& alarms, std::int64_t run_ms) {
  if (alarms.empty()) return;
  Statement alarm(database, "INSERT OR REPLACE INTO alarm VALUES(?,?,?,?,?,?,?,?,?,?,?,?,?)");
  Statement indicator(database, "INSERT OR REPLACE INTO alarm_indicator VALUES(?,?,?,?,?,?,?,?)");
  for (const Alarm& one : alarms) {
    alarm.put(one.id).put(std::string_view(one.valve)).put(std::string_view(one.cause)).put(std::string_view(one.sign));
    alarm.put(one.raised_ms).put(one.gone_ms).put(one.acknowledged_ms).put(std::string_view(one.acknowledged_by));
    alarm.put(one.times).put(one.time_s).put(std::string_view(one.text)).put(one.recording).put(run_ms).run();
    for (std::size_t k = 0; k < one.indicators.size(); ++k) {
      const KeptIndicator& then = one.indicators[k];
      indicator.put(one.id).put(static_cast<std::int64_t>(k)).put(std::string_view(then.name)).put(then.value);
      indicator.put(then.uncertainty_95).put(then.baseline).put(std::string_view(then.state));
      indicator.put(std::string_view(then.unit)).run();
    }
    keep_shelf_and_comments(database, one);
  }
}

std::vector<Alarm> kept_alarms(Database& database, int most_cleared) {
  std::vector<Alarm> out;
  Statement each(database,
                 "SELECT id, valve, cause, sign, raised_ms, gone_ms, acknowledged_ms, acknowledged_by, times, time_s, "
                 "text, recording FROM alarm WHERE gone_ms = 0 OR acknowledged_ms = 0 OR id IN (SELECT alarm FROM "
                 "alarm_shelf) OR id IN (SELECT id FROM alarm WHERE gone_ms <> 0 AND acknowledged_ms <> 0 ORDER BY id "
                 "DESC LIMIT ?) ORDER BY id");
  each.put(std::int64_t{most_cleared});
  while (each.next()) {
    Alarm& one = out.emplace_back();
    one.id = each.integer(0);
    one.valve = each.text(1);
    one.cause = each.text(2);
    one.sign = each.text(3);
    one.raised_ms = each.integer(4);
    one.gone_ms = each.integer(5);
    one.acknowledged_ms = each.integer(6);
    one.acknowledged_by = each.text(7);
    one.times = each.integer(8);
    one.time_s = each.real(9);
    one.text = each.text(10);
    one.recording = each.integer(11);
  }
  Statement then(database,
                 "SELECT name, value, uncertainty_95, baseline, state, unit FROM alarm_indicator WHERE alarm = ? ORDER "
                 "BY place");
  for (Alarm& one : out) {
    then.put(one.id);
    while (then.next()) {
      one.indicators.push_back({then.text(0), then.real(1), then.real(2), then.real(3), then.text(4), then.text(5)});
    }
  }
  read_shelves_and_comments(database, out);
  return out;
}

void delete_alarms(Database& database, std::int64_t before_run_ms) {
  const char* const which =
      "gone_ms <> 0 AND acknowledged_ms <> 0 AND run_ms < ? AND id NOT IN (SELECT alarm FROM alarm_shelf)";
  for (const char* const table : {"alarm_indicator", "alarm_comment"}) {
    Statement(database, fmt::format("DELETE FROM {} WHERE alarm IN (SELECT id FROM alarm WHERE {})", table, which))
        .put(before_run_ms)
        .run();
  }
  Statement(database, fmt::format("DELETE FROM alarm WHERE {}", which)).put(before_run_ms).run();
}

}  // namespace spoolflow::live
