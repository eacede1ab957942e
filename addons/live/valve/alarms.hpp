#pragma once
/// The alarm list of a site after ISA-18.2: one alarm a valve and cause, latched until it is gone and acknowledged.
///
///     raised, unacknowledged -> raised, acknowledged
///              |        ^              |
///     gone, unacknowledged -------> cleared
///
/// Whatever it is, it can be shelved for a time; then it comes back by itself, unacknowledged where it still stands.
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "addons/live/history/alarm_table.hpp"
#include "addons/live/valve/troubles.hpp"

namespace spoolflow::live {

/// "raised_unacknowledged", "raised_acknowledged", "gone_unacknowledged", "cleared" or, whatever else it is, "shelved".
[[nodiscard]] std::string_view state_of(const Alarm& alarm);

/// Of an alarm's text "M", "S", "C" or "F".
[[nodiscard]] monitor::Ne107 sign_named(std::string_view text);

/// How long something must stand until it is raised, and be away until it is gone, by the wall clock.
struct AlarmDelays {
  double raised_after_s = 2;
  double gone_after_s = 10;
};

/// Since when a cause stands that is no alarm yet, or that of an alarm is away.
struct AlarmWait {
  std::string valve, cause;
  std::int64_t since_ms;
  bool stands;
};

/// What became of an alarm.
struct AlarmChange {
  enum class Kind : std::uint8_t { raised, worse, back, gone };  ///< back: from the shelf
  Kind kind;
  Alarm alarm;
};

/// Safe to be asked from any thread.
class Alarms {
 public:
  static constexpr int most_cleared = 200;           ///< of those at hand; the store keeps the others
  static constexpr std::size_t most_comments = 100;  ///< of an alarm: the oldest leave

  explicit Alarms(const AlarmDelays& delays) : delays_(delays) {}
  /// From the store, ascending by id.
  void restore(std::vector<Alarm> alarms);
  /// With what was waited for, so that it goes on as if it had never stopped.
  void restore(std::vector<Alarm> alarms, const std::vector<AlarmWait>& waits);
  [[nodiscard]] std::vector<AlarmWait> waits() const;

  /// Takes what is wrong with one valve now, `now_ms` since 1970-01-01 UTC.
  std::vector<AlarmChange> follow(const ValveView& valve, const std::vector<Trouble>& troubles, std::int64_t now_ms);
  /// Nothing where there is no such alarm; one that was acknowledged before stays as it was.
  std::optional<Alarm> acknowledge(std::int64_t id, const std::string& by, std::int64_t now_ms);
  /// Until then it is nobody's business; one that is cleared stays as it was. Nothing where there is no such alarm, in
  /// all of these.
  std::optional<Alarm> shelve(std::int64_t id, const std::string& by, std::int64_t until_ms, std::int64_t now_ms);
  /// At once, as at the end of its time.
  std::optional<Alarm> unshelve(std::int64_t id);
  std::optional<Alarm> comment(std::int64_t id, const AlarmComment& comment);
  /// The raw samples around it are kept under that number.
  void name_recording(std::int64_t id, std::int64_t recording);

  /// Ascending by id.
  [[nodiscard]] std::vector<Alarm> all() const;
  /// Changed since it was asked the last time.
  [[nodiscard]] std::vector<Alarm> take_changed();
  /// They could not be kept.
  void give_back(const std::vector<Alarm>& alarms);

 private:
  struct Entry {
    Alarm alarm;
    std::int64_t away_since_ms = 0;  ///< 0: it is there
  };
  /// Stands, but not for long enough to be raised.
  struct Pending {
    std::string valve, cause;
    std::int64_t since_ms;
  };
  Entry* listed(const std::string& valve, const std::string& cause);
  bool has_stood(const std::string& valve, const std::string& cause, std::int64_t now_ms);
  void stand(Entry& entry, const Trouble& trouble, std::int64_t now_ms, std::vector<AlarmChange>& changes);
  void forget_the_oldest();
  Entry* numbered(std::int64_t id);
  void take_off_the_shelf(Alarm& alarm);
  void follow_shelf(Alarm& alarm, std::int64_t now_ms, std::vector<AlarmChange>& changes);

  AlarmDelays delays_;
  mutable std::mutex mutex_;
  std::vector<Entry> entries_;  ///< ascending by id
  std::vector<Pending> pending_;
  std::set<std::int64_t> changed_;
  std::int64_t next_id_ = 1;
};

}  // namespace spoolflow::live
