#pragma once
/// Watches a site's valves and sources: what changes of their condition, alarms and samples becomes an event.
#include <string>
#include <vector>

#include "addons/live/alarm_recording.hpp"
#include "addons/live/journal.hpp"
#include "addons/live/valve_sources.hpp"

namespace spoolflow::live {

class ValveWatch {
 public:
  /// All outlive it.
  ValveWatch(const SiteSettings& site, const Valves& valves, const ValveSources& sources, Journal& journal);

  /// Before the first look: the valves' conditions were reported before the program started. `store`, which outlives
  /// it, gets raw samples around alarms; without it none are kept.
  void resume(Store& store);
  /// To be called each second.
  void look();

 private:
  /// What was reported last of a valve.
  struct Reported {
    bool stalled = false;
    monitor::Ne107 condition = monitor::Ne107::good;
    std::string trouble{}, unread{};
    std::vector<std::string> findings{};
    AlarmRecording recording{};
  };
  void look_at_source(const ValveView& valve, const SourceView& source, Reported& before);
  void follow_alarms(const ValveView& valve, bool stalled, Reported& before);

  const SiteSettings& site_;
  const Valves& valves_;
  const ValveSources& sources_;
  Store* store_ = nullptr;
  Journal& journal_;
  std::vector<Reported> reported_;
};

}  // namespace spoolflow::live
