#pragma once
/// What people do with alarms: acknowledge, shelve, take off the shelf, comment. Formats: docs/live.md.
#include <optional>
#include <string>

#include "addons/live/engine.hpp"
#include "addons/live/http/page_content.hpp"

namespace spoolflow::live {

/// The alarm as it is then, as JSON, or why it is refused. Nothing where the order names no alarm by a number.
[[nodiscard]] std::optional<PageAnswer> act_on_alarm(Engine& engine, const AlarmOrder& order, const std::string& by);

}  // namespace spoolflow::live
