#include "addons/fleet/store/alarm_desk.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace spoolflow::fleet {
namespace {

constexpr std::int64_t most_comments = 100;

live::Alarm alarm_of(const Rows& rows, int row) {
  live::Alarm out{.id = rows.integer(row, 1), .valve = rows.text(row, 0)};
  out.cause = rows.text(row, 2);
  out.sign = rows.text(row, 3);
  out.raised_ms = rows.integer(row, 4);
  out.gone_ms = rows.integer(row, 5);
  out.acknowledged_ms = rows.integer(row, 6);
  out.acknowledged_by = rows.text(row, 7);
  out.times = rows.integer(row, 8);
  out.time_s = rows.real(row, 9);
  out.text = rows.text(row, 10);
  out.shelved_ms = rows.integer(row, 11);
  out.shelved_until_ms = rows.integer(row, 12);
  out.shelved_by = rows.text(row, 13);
  return out;
}

/// `valve`: of one alone; empty: of all. Of alarms that are listed alone.
void add_comments(Session& session, const std::string& valve, std::vector<live::Alarm>& alarms) {
  std::map<std::pair<std::string, std::int64_t>, live::Alarm*> places;
  for (live::Alarm& one : alarms) places[{one.valve, one.id}] = &one;
  const Rows rows = session.run(
      "SELECT valve, alarm, wall_ms, name, text FROM alarm_comment WHERE $1 = '' OR valve = $1 ORDER BY number",
      Values().put(std::string_view(valve)));
  for (int row = 0; row < rows.size(); ++row) {
    const auto place = places.find({rows.text(row, 0), rows.integer(row, 1)});
    if (place == places.end()) continue;
    place->second->comments.push_back({rows.integer(row, 2), rows.text(row, 3), rows.text(row, 4)});
  }
}

Values named(const AlarmAct& act) {
  return Values().put(std::string_view(act.valve)).put(act.alarm);
}

std::optional<live::Alarm> as_it_is(Session& session, const AlarmAct& act) {
  const Rows found = session.run("SELECT * FROM alarm_seen WHERE valve = $1 AND id = $2", named(act));
  if (found.size() == 0) return std::nullopt;
  std::vector<live::Alarm> one{alarm_of(found, 0)};
  add_comments(session, act.valve, one);
  return one.front();
}

}  // namespace

std::vector<live::Alarm> fleet_alarms(Session& session, const std::string& valve, int most_cleared) {
  const Values whose = Values().put(std::string_view(valve)).put(std::int64_t{most_cleared});
  const Rows open = session.run(
      "SELECT * FROM alarm_seen WHERE (gone_ms = 0 OR acknowledged_ms = 0 OR shelved_ms != 0) AND ($1 = '' OR valve = "
      "$1) ORDER BY raised_ms DESC, valve, id LIMIT 20000 + 0 * $2::bigint",
      whose);
  std::vector<live::Alarm> out;
  for (int row = 0; row < open.size(); ++row) out.push_back(alarm_of(open, row));
  const Rows cleared = session.run(
      "SELECT * FROM alarm_seen WHERE gone_ms != 0 AND acknowledged_ms != 0 AND shelved_ms = 0 AND ($1 = '' OR valve = "
      "$1) ORDER BY raised_ms DESC, valve, id LIMIT $2::bigint",
      whose);
  for (int row = 0; row < cleared.size(); ++row) out.push_back(alarm_of(cleared, row));
  std::stable_sort(out.begin(), out.end(),
                   [](const live::Alarm& a, const live::Alarm& b) { return a.raised_ms > b.raised_ms; });
  add_comments(session, valve, out);
  return out;
}

std::optional<live::Alarm> acknowledge(Session& session, const AlarmAct& act) {
  session.run(
      "INSERT INTO acknowledgement(valve, alarm, wall_ms, name) SELECT valve, id, $3::bigint, $4 FROM alarm WHERE "
      "valve = $1 AND id = $2 AND acknowledged_ms = 0 ON CONFLICT DO NOTHING",
      named(act).put(act.wall_ms).put(std::string_view(act.by)));
  return as_it_is(session, act);
}

std::optional<live::Alarm> shelve(Session& session, const AlarmAct& act, std::int64_t until_ms) {
  session.run(
      "INSERT INTO alarm_shelf(valve, alarm, wall_ms, until_ms, name) SELECT valve, id, $3::bigint, $4::bigint, $5 "
      "FROM "
      "alarm_seen WHERE valve = $1 AND id = $2 AND (gone_ms = 0 OR acknowledged_ms = 0) ON CONFLICT(valve, alarm) DO "
      "UPDATE SET wall_ms = excluded.wall_ms, until_ms = excluded.until_ms, name = excluded.name",
      named(act).put(act.wall_ms).put(until_ms).put(std::string_view(act.by)));
  return as_it_is(session, act);
}

std::optional<live::Alarm> unshelve(Session& session, const AlarmAct& act) {
  session.run("DELETE FROM alarm_shelf WHERE valve = $1 AND alarm = $2", named(act));
  return as_it_is(session, act);
}

std::optional<live::Alarm> comment(Session& session, const AlarmAct& act, const std::string& text) {
  FleetTransaction whole(session);
  session.run(
      "INSERT INTO alarm_comment(valve, alarm, wall_ms, name, text) SELECT valve, id, $3::bigint, $4, $5 FROM alarm "
      "WHERE "
      "valve = $1 AND id = $2",
      named(act).put(act.wall_ms).put(std::string_view(act.by)).put(std::string_view(text)));
  session.run(
      "DELETE FROM alarm_comment WHERE valve = $1 AND alarm = $2 AND number <= (SELECT number FROM alarm_comment WHERE "
      "valve = $1 AND alarm = $2 ORDER BY number DESC OFFSET $3::bigint LIMIT 1)",
      named(act).put(most_comments));
  whole.commit();
  return as_it_is(session, act);
}

}  // namespace spoolflow::fleet
