#pragma once
/// Raw samples around an alarm: once those behind it have come, or no more come, they go into the store as a recording.
#include <optional>
#include <string>
#include <vector>

#include "addons/live/history/store.hpp"
#include "addons/live/journal.hpp"
#include "addons/live/valve/valve_at_work.hpp"

namespace spoolflow::live {

/// Of one valve.
class AlarmRecording {
 public:
  /// Of what time about the alarm [s].
  struct Span {
    double before_s, after_s;
  };
  /// An alarm that is raised by `valve` while another waits for its samples shares that one's recording.
  void raised(const Alarm& alarm, const ValveView& valve);
  /// `nothing_comes`: no more samples are to be waited for. `valve`: of `at_work`.
  void follow(const ValveAtWork& at_work, const ValveView& valve, bool nothing_comes, const Span& span, Store& store,
              Journal& journal);

 private:
  std::optional<double> alarm_s_{};  ///< by the source's clock; nothing: none waits
  std::string why_{};
  std::vector<std::int64_t> alarms_{};  ///< that were raised since then
};

}  // namespace spoolflow::live
