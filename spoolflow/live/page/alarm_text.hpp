#pragma once
/// Alarms as JSON. Formats: docs/live.md. Included by the files that write JSON only.
#include <string>

#include "spoolflow/live/alarms.hpp"
#include "spoolflow/live/door/json_text.hpp"

namespace spoolflow::live {

/// One of {"alarms": [...]} of /api/v1/alarms.
[[nodiscard]] Json json_of(const Alarm& alarm);

}  // namespace spoolflow::live
