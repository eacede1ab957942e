#pragma once
/// What is wrong with a valve now, as its monitor and its source say.
#include <string>
#include <string_view>
#include <vector>

#include "addons/live/valve/valve_at_work.hpp"

namespace spoolflow::live {

/// One thing that is wrong with a valve at an instant.
struct Trouble {
  std::string cause;  ///< of the monitor, no_samples, or the words of its sign ("function_check")
  monitor::Ne107 sign;
  double odds = 0;  ///< of the monitor's causes; 0: no matter of odds
};
/// The cause that the sources make.
inline constexpr std::string_view no_samples = "no_samples";
/// What makes the valve's condition; what the monitor merely suspects is none of it. `stalled`: no samples come.
[[nodiscard]] std::vector<Trouble> troubles_of(const ValveView& valve, bool stalled);

}  // namespace spoolflow::live
