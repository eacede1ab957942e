#pragma once
/// Alarms as the store keeps them, with what was known when they were raised.
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "addons/live/history/sqlite.hpp"

namespace spoolflow::live {

/// What a monitor said of one of its figures, in the unit that it reported.
struct KeptIndicator {
  std::string name;
  double value, uncertainty_95, baseline;
  std::string state;
  std::string unit{};
};

struct AlarmComment {
  std::int64_t at_ms = 0;  ///< since 1970-01-01 UTC
  std::string by{}, text{};
};

/// One cause at one valve, from when it was raised until it is gone and acknowledged.
struct Alarm {
  std::int64_t id = 0;  ///< ascending
  std::string valve{};
  std::string cause{};
  std::string sign{};                ///< of NE 107, the worst so far: "M", "S", "C" or "F"
  std::int64_t raised_ms = 0;        ///< since 1970-01-01 UTC; of the first time
  std::int64_t gone_ms = 0;          ///< 0: it is there
  std::int64_t acknowledged_ms = 0;  ///< 0: not yet
  std::string acknowledged_by{};
  std::int64_t times = 1;                                    ///< that it was raised
  double time_s = std::numeric_limits<double>::quiet_NaN();  ///< by the source's clock, when it was first raised
  std::string text{};                                        ///< what was seen then
  std::int64_t recording = 0;                                ///< of the raw samples around it; 0: none
  std::vector<KeptIndicator> indicators{};                   ///< when it was first raised
  std::int64_t shelved_ms = 0, shelved_until_ms = 0;         ///< 0: it is not shelved
  std::string shelved_by{};
  std::vector<AlarmComment> comments{};  ///< the oldest first
};

/// Where there is none yet; files of programs that knew no alarms get it, too.
void make_alarm_tables(Database& database);
/// In the transaction of the caller, at that run time; an alarm that is there already is replaced.
void keep_alarms(Database& database, const std::vector<Alarm>& alarms, std::int64_t run_ms);
/// Those that are not gone and acknowledged or are shelved, and of the others the newest; ascending by id.
[[nodiscard]] std::vector<Alarm> kept_alarms(Database& database, int most_cleared);
/// Those that are gone, acknowledged and not shelved, and have not changed since that run time.
void delete_alarms(Database& database, std::int64_t before_run_ms);

}  // namespace spoolflow::live
