#pragma once
/// What happened at a site: its events and alarms, and who reports the program's own events beside the page.
#include <functional>
#include <string>

#include "addons/live/reported_alarms.hpp"
#include "addons/live/valve/alarms.hpp"
#include "addons/live/valve/events.hpp"

namespace spoolflow::live {

struct Journal {
  explicit Journal(const AlarmDelays& delays) : alarms(delays) {}

  /// An event of the program itself, also handed to `report`.
  void note(const std::string& text) {
    events.add({.wall_ms = wall_ms(), .kind = "program", .text = text});
    if (report) report(text);
  }

  Events events{};
  Alarms alarms;
  ReportedAlarms reported{};
  std::function<void(const std::string&)> report{};  ///< such as at standard error; empty: the page alone
};

}  // namespace spoolflow::live
