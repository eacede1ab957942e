#pragma once
/// The alarms of a fleet, and what people do with them: acknowledge, shelve, comment.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "addons/fleet/store/postgresql.hpp"
#include "addons/live/history/alarm_table.hpp"

namespace spoolflow::fleet {

/// All that are not cleared or are shelved, and the newest of the others; newest first. Acknowledged as soon as
/// somebody has acknowledged them. `valve`: of one alone; empty: of all.
[[nodiscard]] std::vector<live::Alarm> fleet_alarms(Session& session, const std::string& valve, int most_cleared);

/// Somebody does something with an alarm.
struct AlarmAct {
  std::string valve;  ///< "SITE/ID"
  std::int64_t alarm;
  std::string by;
  std::int64_t wall_ms;  ///< since 1970-01-01 UTC
};

/// Each returns the alarm as it is then; nothing where there is no such alarm.
///
/// Keeps that it was seen; its worker takes it with the next commit. One that was acknowledged before stays as it was.
[[nodiscard]] std::optional<live::Alarm> acknowledge(Session& session, const AlarmAct& act);
/// Until then it counts nowhere; workers know nothing of it, and then it is as it was. One that is cleared stays.
[[nodiscard]] std::optional<live::Alarm> shelve(Session& session, const AlarmAct& act, std::int64_t until_ms);
[[nodiscard]] std::optional<live::Alarm> unshelve(Session& session, const AlarmAct& act);
/// An alarm has 100 comments at most: the oldest leave.
[[nodiscard]] std::optional<live::Alarm> comment(Session& session, const AlarmAct& act, const std::string& text);

}  // namespace spoolflow::fleet
