#pragma once
/// What the page server answers, as text. Formats: docs/live.md.
#include <string>

#include "addons/live/engine.hpp"

namespace spoolflow::live {

/// JSON of /api/v1/valves: {"valves": [...]}.
[[nodiscard]] std::string valves_json(const Engine& engine);
/// JSON of /api/v1/valves/ID: one of them.
[[nodiscard]] std::string valve_json(const Engine& engine, std::size_t valve);
/// JSON of /api/v1/events: {"events": [...]}, newest first.
[[nodiscard]] std::string events_json(const Engine& engine);
/// JSON of /api/v1/alarms: {"alarms": [...]}, newest first; those cleared long ago are left out.
[[nodiscard]] std::string alarms_json(const Engine& engine);
/// JSON of /api/v1/recordings: {"recordings": [{"id", "time", "valve", "why"}]}, newest first.
[[nodiscard]] std::string recordings_json(const Engine& engine);
/// JSON of /api/v1/site: totals, sources, store.
[[nodiscard]] std::string site_json(const Engine& engine);
/// Prometheus text format 0.0.4 of /metrics.
[[nodiscard]] std::string metrics_text(const Engine& engine);

}  // namespace spoolflow::live
