#pragma once
/// The fleet's tables in PostgreSQL. second, state, indicator, event, alarm and alarm_indicator are those of one
/// machine's store (live/store) with a block's place beside; docs/fleet.md tells all of them.
#include "spoolflow/fleet/store/postgresql.hpp"

namespace spoolflow::fleet {

inline constexpr std::int64_t schema_version = 2;

/// What all workers must agree in, or their results would differ.
struct SharedSettings {
  std::int64_t partitions = 0;
  double raised_after_s = 2, gone_after_s = 10;  ///< of alarms, by the sites' clocks
};

/// Makes tables, partitions and the roles spoolflow_worker, spoolflow_reader and spoolflow_page where they are missing,
/// brings older tables to this version, and keeps the settings. Returns false where all was there before. Throws
/// ServerRefuses where they are of another version.
bool make_schema(Session& session, const SharedSettings& settings);
/// Throws ServerRefuses, which says to run --setup, where there are none, and where they are of another version.
[[nodiscard]] SharedSettings read_settings(Session& session);

}  // namespace spoolflow::fleet
