#pragma once
/// The fleet's tables in PostgreSQL. second, state, indicator, event, alarm and alarm_indicator are those of one
/// machine's store (live/store) with a block's place beside; docs/fleet.md lists all of them.
#include "addons/fleet/store/postgresql.hpp"

namespace spoolflow::fleet {

inline constexpr std::int64_t schema_version = 5;

/// What all workers must agree in, or their results would differ.
struct SharedSettings {
  std::int64_t partitions = 0;
  double raised_after_s = 2, gone_after_s = 10;  ///< of alarms, by the sites' clocks
};

/// What there was to do.
enum class SchemaWork : std::uint8_t { nothing, made, upgraded };

/// Makes tables, partitions and the roles spoolflow_worker, spoolflow_reader, spoolflow_page and spoolflow_batch where
/// they are missing, brings older tables to this version with all their rows, and keeps the settings. Throws
/// ServerRefuses where they are of a newer version.
SchemaWork make_schema(Session& session, const SharedSettings& settings);
/// Throws ServerRefuses, which says to run --setup, where there are none, and where they are of another version.
[[nodiscard]] SharedSettings read_settings(Session& session);

}  // namespace spoolflow::fleet
