#pragma once
/// The events that a valve's condition and its alarms make.
#include "addons/live/valve/alarms.hpp"
#include "addons/live/valve/valve_at_work.hpp"

namespace spoolflow::live {

/// The sign of NE 107 is another than `before`.
[[nodiscard]] Event condition_event(const ValveView& valve, monitor::Ne107 before, std::int64_t wall_ms);
/// The system's clock was set forward (> 0) or back by that, and is there now.
[[nodiscard]] std::string clock_text(std::int64_t wall_ms, std::int64_t step_ms);
[[nodiscard]] Event alarm_event(const ValveView& valve, const AlarmChange& change, std::int64_t wall_ms);

}  // namespace spoolflow::live
