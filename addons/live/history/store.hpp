#pragma once
/// What one machine keeps of its valves, in one SQLite file (WAL). Each commit covers all valves: a summary of what
/// came since the commit before, the state from which the program goes on, events. After an end at any instant the file
/// is that of the last commit.
///
/// SQLite writes whole pages: the rows of one second lie side by side in a table of the newest, and move to that in
/// which each valve's are together once a minute (the view `second` has both). Of a state what differs from an older
/// one is written, and that one again where the differences have grown.
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "addons/live/history/alarm_table.hpp"
#include "addons/live/history/file_lock.hpp"
#include "addons/live/history/file_watch.hpp"
#include "addons/live/history/outbox_table.hpp"
#include "addons/live/history/reported_table.hpp"
#include "addons/live/history/retention.hpp"
#include "addons/live/history/run_time.hpp"
#include "addons/live/history/source_count_table.hpp"
#include "addons/live/history/sqlite.hpp"

namespace spoolflow::live {

/// Smallest, mean and largest value of the answers between two commits, which are a second apart.
struct Summary {
  std::int64_t samples = 0;
  double time_s = 0;  ///< of the last sample, by the source's clock
  double flow_min_m3_per_s = 0, flow_mean_m3_per_s = 0, flow_max_m3_per_s = 0;
  double lower_min_m3_per_s = 0, upper_max_m3_per_s = 0;  ///< ends of the 95 % band
  double energy_J = 0;                                    ///< hydraulic, through the edge
  std::uint32_t status = 0;                               ///< bits that were set at least once
};

/// From where a valve goes on.
struct KeptState {
  std::string valve{};
  std::uint64_t session = 0, next = 0;  ///< of its source
  std::uint64_t samples = 0;            ///< worked on since the store began
  double energy_J = 0;                  ///< since then
  std::string layout{};                 ///< what the bytes are of; of another layout they are not taken
  std::vector<std::byte> bytes{};       ///< of sensor and monitor
  SourceCounts counts{};                ///< up to the sample `next`, since the store began
};

struct ValveCommit {
  KeptState state;
  Summary since_last;                     ///< nothing came where it has no samples
  std::vector<KeptIndicator> indicators;  ///< written where there are any
  std::vector<OutboxBlock> blocks{};      ///< for the fleet, until it has them
  std::uint64_t outbox_session = 0;       ///< of these
};

struct Event {
  std::int64_t id = 0;       ///< ascending; given by the store
  std::int64_t wall_ms = 0;  ///< since 1970-01-01 UTC
  std::string valve{};
  double time_s = 0;  ///< by the source's clock
  std::string kind;   ///< "alarm", "condition", "source", "recording", "program"
  std::string text{};
  std::int64_t acknowledged_ms = 0;  ///< 0: not yet
};

/// Raw samples around an alarm.
struct KeptRecording {
  std::int64_t id = 0;  ///< ascending; given by the store
  std::int64_t wall_ms = 0;
  std::string valve{};
  std::string why{};
  std::string csv{};  ///< with the header of a recording; empty in lists
};

struct HistoryRow {
  std::int64_t wall_ms;
  Summary summary;
};

class Store {
 public:
  /// Makes the file where there is none. Throws StoreError: of a newer version, damaged, of another program, held by
  /// another spoolflow live, or where file or folder may not be written to.
  explicit Store(const std::string& path);
  ~Store();

  /// To be asked before each commit: whether the file is still there and sound. Returns what was done about it, in
  /// words; empty: all is well.
  ///
  /// Deleted, it is written again with all that it held, as the open file still has that. Where another has its name,
  /// or its log is gone, what it held is saved likewise. A damaged one is set aside as it is, and a store begins again.
  /// Throws StoreError where none of this can be done now: nothing is kept meanwhile, and the next call tries again.
  [[nodiscard]] std::string look_after(std::int64_t wall_ms);
  /// After a store started again, or goes on in another file: events and alarms that are known, with their numbers, and
  /// who has a message of them; and the next commit has the states of all valves.
  void keep_again(const std::vector<Event>& events, const std::vector<Alarm>& alarms,
                  const ReportedTexts& reported = {});

  [[nodiscard]] std::vector<KeptState> states();
  /// One transaction. Throws StoreError, and then nothing of it is kept.
  void commit(const Instant& now, const std::vector<ValveCommit>& valves, std::vector<Event>& events,
              const std::vector<Alarm>& alarms = {}, const ReportedTexts& reported = {});
  /// Of the newest row; 0 where there is none.
  [[nodiscard]] RowTime newest() const { return run_time_ ? run_time_->newest() : RowTime{}; }
  [[nodiscard]] std::vector<OutboxPosition> positions() { return outbox_positions(*database_); }
  [[nodiscard]] std::uint64_t session(std::int64_t wall_ms) { return outbox_session(*database_, wall_ms); }
  /// Each commit waits for the disk from now on: a block whose number was given away must not be forgotten.
  void keep_on_disk();
  /// The fleet has the blocks of these valves up to their `covered`. Throws StoreError.
  void cover(const std::vector<OutboxPosition>& covered);
  /// As live::drop_oldest_blocks(). Throws StoreError.
  std::int64_t drop_oldest_blocks(double largest_MB) { return live::drop_oldest_blocks(open_one(), largest_MB); }
  /// The newest, ascending by id.
  [[nodiscard]] std::vector<Event> events(int most);
  /// As kept_alarms().
  [[nodiscard]] std::vector<Alarm> alarms(int most_cleared) { return kept_alarms(*database_, most_cleared); }
  [[nodiscard]] ReportedTexts reported() { return kept_reports(*database_); }
  /// Returns its number. Throws StoreError.
  std::int64_t keep_recording(const KeptRecording& recording);
  /// Deletes what is older or more than that, as delete_old(). Throws StoreError.
  void retain(const Retention& retention);

 private:
  struct Statements;
  std::int64_t number_of(const std::string& valve);
  void put_row(std::int64_t valve, const RowTime& at, const Summary& row);
  void put_state(std::int64_t valve, const KeptState& state);
  void move_rows();
  void commit_all(const RowTime& at, const std::vector<ValveCommit>& valves, std::vector<Event>& events,
                  const std::vector<Alarm>& alarms, const ReportedTexts& reported);

  void open();
  /// Leaves file and log as they are.
  void close();
  [[nodiscard]] Database& open_one();
  void save_as(const std::string& path);
  [[nodiscard]] std::string rewrite();
  [[nodiscard]] std::string go_on_in_another(const std::string& stamp);
  [[nodiscard]] std::string set_aside(const std::string& stamp);
  std::string path_;
  bool on_disk_ = false;
  std::optional<FileLock> lock_;        ///< longer than the database
  std::unique_ptr<Database> database_;  ///< nothing: it could not be opened again
  std::unique_ptr<Statements> statements_;
  std::optional<RunTime> run_time_;
  std::optional<FileWatch> watch_;
  bool damaged_ = false;       ///< a commit met it
  bool needs_states_ = false;  ///< of all valves
};

/// Works while another program writes. Throws StoreError where the file is no store of this version.
[[nodiscard]] Database open_store_to_read(const std::string& path);

/// The newest recordings without their samples, newest first. Throws StoreError as read_history() does.
[[nodiscard]] std::vector<KeptRecording> list_recordings(const std::string& path, int most);
/// One of them as a whole; nothing where there is none of this number.
[[nodiscard]] std::optional<KeptRecording> read_recording(const std::string& path, std::int64_t id);

/// Rows of a valve with from_ms <= wall_ms < to_ms, in order. Works while another program writes. Throws StoreError
/// where the file is no store, and where it knows no such valve, naming those that it knows.
void read_history(const std::string& path, const std::string& valve, std::int64_t from_ms, std::int64_t to_ms,
                  const std::function<void(const HistoryRow&)>& each);

}  // namespace spoolflow::live
