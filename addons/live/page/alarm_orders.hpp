#pragma once
/// What people do with alarms: acknowledge, shelve, take off the shelf, comment. Formats: docs/live.md.
#include <optional>
#include <string>

#include "addons/live/engine.hpp"
#include "addons/live/http/page_content.hpp"

namespace spoolflow::live {

/// Of the body of an order: a number > 0 of hours, at most a week; nothing where it is none.
[[nodiscard]] std::optional<double> hours_asked(std::string_view body);
/// A comment on one line, without blanks at its ends; nothing where it is none, or too long.
[[nodiscard]] std::optional<std::string> comment_asked(std::string_view body);
/// What is answered then.
[[nodiscard]] PageAnswer no_hours();
[[nodiscard]] PageAnswer no_comment();
/// To who shelves an alarm that is cleared.
[[nodiscard]] PageAnswer is_cleared();

/// The alarm as it is then, as JSON, or why it is refused. Nothing where the order names no alarm by a number.
[[nodiscard]] std::optional<PageAnswer> act_on_alarm(Engine& engine, const AlarmOrder& order, const std::string& by);

}  // namespace spoolflow::live
