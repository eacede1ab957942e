#pragma once
/// When rows are kept, by two clocks. The system's clock says at which time of day; people and networks set it forward
/// and back. The run time of a store, the time for which programs have worked on it, says how old a row is: it goes on
/// from the newest row in the file by elapsed time alone.
#include <cstdint>

#include "addons/live/history/sqlite.hpp"

namespace spoolflow::live {

/// An instant by the system's clock and by one that nobody sets.
struct Instant {
  std::int64_t wall_ms = 0;    ///< since 1970-01-01 UTC
  std::int64_t steady_ms = 0;  ///< since the machine started, its sleep included
};
[[nodiscard]] Instant instant();

/// For how long the system's clock was set forward (> 0) or back between two instants of one program; 0 where both
/// clocks went alike.
[[nodiscard]] std::int64_t clock_step_ms(const Instant& before, const Instant& now);

/// Of one commit.
struct RowTime {
  std::int64_t wall_ms = 0;
  std::int64_t run_ms = 0;
};

class RunTime {
 public:
  /// As the file has it.
  explicit RunTime(Database& database);
  /// For the rows of the next commit: a run time beyond all that the file has, and a time of day that no row has. After
  /// a clock was set back the latter is the next millisecond that is free.
  [[nodiscard]] RowTime next(Database& database, const Instant& now) const;
  /// The commit was kept.
  void kept(const RowTime& row, const Instant& now);
  /// Of the newest row; 0 where there is none.
  [[nodiscard]] const RowTime& newest() const { return newest_; }

 private:
  RowTime newest_;                  ///< by run time
  std::int64_t latest_wall_ms_;     ///< of all rows
  std::int64_t begun_steady_ms_{};  ///< of this program's first commit
  std::int64_t begun_run_ms_ = 0;   ///< of that one; 0: none yet
};

}  // namespace spoolflow::live
