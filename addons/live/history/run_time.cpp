#include "addons/live/history/run_time.hpp"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <limits>

namespace spoolflow::live {
namespace {

/// Both clocks are read one behind the other; what they drift apart by is smaller.
constexpr std::int64_t least_step_ms = 500;

std::int64_t steady_ms() {
  timespec now{};
  ::clock_gettime(CLOCK_BOOTTIME, &now);
  return std::int64_t{1000} * now.tv_sec + now.tv_nsec / 1'000'000;
}

}  // namespace

Instant instant() {
  using std::chrono::system_clock;
  for (;;) {
    const std::int64_t before_ms = steady_ms();
    const auto wall = system_clock::now().time_since_epoch();
    const std::int64_t after_ms = steady_ms();
    // A thread that waited for a core in between would see a step.
    if (after_ms - before_ms > least_step_ms / 10) continue;
    return {std::chrono::duration_cast<std::chrono::milliseconds>(wall).count(), before_ms};
  }
}

std::int64_t clock_step_ms(const Instant& before, const Instant& now) {
  const std::int64_t step_ms = (now.wall_ms - before.wall_ms) - (now.steady_ms - before.steady_ms);
  return std::abs(step_ms) < least_step_ms ? 0 : step_ms;
}

RunTime::RunTime(Database& database) : latest_wall_ms_(std::numeric_limits<std::int64_t>::min()) {
  Statement rows(database, "SELECT run_ms, wall_ms FROM newest_second UNION ALL SELECT run_ms, to_ms FROM stretch");
  while (rows.next()) {
    const RowTime row{.wall_ms = rows.integer(1), .run_ms = rows.integer(0)};
    latest_wall_ms_ = std::max(latest_wall_ms_, row.wall_ms);
    if (row.run_ms >= newest_.run_ms) newest_ = row;
  }
  newest_.run_ms = std::max(newest_.run_ms, database.number("SELECT coalesce(max(run_ms), 0) FROM event"));
}

RowTime RunTime::next(Database& database, const Instant& now) const {
  RowTime out{.wall_ms = now.wall_ms, .run_ms = newest_.run_ms + 1};
  if (begun_run_ms_ > 0) out.run_ms = std::max(out.run_ms, begun_run_ms_ + now.steady_ms - begun_steady_ms_);
  if (out.wall_ms > latest_wall_ms_) return out;
  Statement taken(database,
                  "SELECT EXISTS(SELECT 1 FROM newest_second WHERE wall_ms = ?1) OR EXISTS(SELECT 1 FROM valve WHERE "
                  "EXISTS(SELECT 1 FROM second_of_valve AS one WHERE one.valve = number AND one.wall_ms = ?1) OR "
                  "EXISTS(SELECT 1 FROM indicator AS one WHERE one.valve = number AND one.wall_ms = ?1))");
  for (;; ++out.wall_ms) {
    taken.put(out.wall_ms);
    const bool is_taken = taken.next() && taken.integer(0) != 0;
    while (taken.next()) {
    }
    if (!is_taken) return out;
  }
}

void RunTime::kept(const RowTime& row, const Instant& now) {
  if (begun_run_ms_ == 0) {
    begun_run_ms_ = row.run_ms;
    begun_steady_ms_ = now.steady_ms;
  }
  newest_ = row;
  latest_wall_ms_ = std::max(latest_wall_ms_, row.wall_ms);
}

}  // namespace spoolflow::live
