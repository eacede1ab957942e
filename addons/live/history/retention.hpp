#pragma once
/// What a store deletes: the oldest by its run time, never by the system's clock alone.
///
/// Rows of a valve are in the order of the time of day, and so is what is deleted: the table `stretch` says which times
/// of day the rows up to a run time have.
#include "addons/live/history/run_time.hpp"

namespace spoolflow::live {

struct Retention {
  double days = 30;  ///< of run time
  double largest_MB = 2000;
};

/// Rows of the newest seconds move to the table in which each valve's are together, as one stretch.
void move_rows(Database& database);
/// Rows of that time alone are a stretch of their own: indicators of a second without samples.
void keep_stretch(Database& database, const RowTime& row);

/// One pass: what is older or more than that, at most so many rows and a piece of ten minutes; the newest stretch
/// stays. What is left comes with the next pass.
inline constexpr std::int64_t most_rows_a_pass = 200'000;
void delete_old(Database& database, const Retention& retention, std::int64_t run_ms);

}  // namespace spoolflow::live
