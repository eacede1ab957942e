#pragma once
/// What the page server answers, as text. Formats: docs/live.md.
#include <cstddef>
#include <optional>
#include <string>

#include "spoolflow/live/engine.hpp"
#include "spoolflow/live/page/access.hpp"
#include "spoolflow/live/store/long_history.hpp"

namespace spoolflow::live {

/// JSON of /api/v1/valves: {"valves": [...]}.
[[nodiscard]] std::string valves_json(const Engine& engine);
/// JSON of /api/v1/events: {"events": [...]}, newest first.
[[nodiscard]] std::string events_json(const Engine& engine);
/// JSON of /api/v1/alarms: {"alarms": [...]}, newest first; those cleared long ago are left out.
[[nodiscard]] std::string alarms_json(const Engine& engine);
[[nodiscard]] std::string alarm_json(const Alarm& alarm);
/// JSON of /api/v1/session: {"account", "role", "accounts"}.
[[nodiscard]] std::string session_json(const Visitor& visitor, bool has_accounts);
/// What a body of /api/v1/login asks; nothing where it is none.
struct LoginAsked {
  std::string name, password;
};
[[nodiscard]] std::optional<LoginAsked> login_of(const std::string& body);
/// JSON of /api/v1/valves/ID/indicators and /history: columns over time, thinned.
[[nodiscard]] std::string indicator_history_json(const Engine& engine, std::size_t valve, const Span& span);
[[nodiscard]] std::string flow_history_json(const Engine& engine, std::size_t valve, const Span& span);
/// JSON of /api/v1/recordings: {"recordings": [{"id", "time", "valve", "why"}]}, newest first.
[[nodiscard]] std::string recordings_json(const Engine& engine);
/// JSON of /api/v1/site: totals, sources, store.
[[nodiscard]] std::string site_json(const Engine& engine);
/// Prometheus text format 0.0.4 of /metrics.
[[nodiscard]] std::string metrics_text(const Engine& engine);

}  // namespace spoolflow::live
