#pragma once
/// Alarms as JSON. Formats: docs/live.md. Included by the files that write JSON only.
#include <string>

#include "addons/live/http/json_text.hpp"
#include "addons/live/valve/alarms.hpp"

namespace spoolflow::live {

/// One of {"alarms": [...]} of /api/v1/alarms.
[[nodiscard]] Json json_of(const Alarm& alarm);

}  // namespace spoolflow::live
