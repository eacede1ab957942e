#include "addons/live/valve/troubles.hpp"

#include <algorithm>

#include "spoolflow/monitor/isolation.hpp"

namespace spoolflow::live {

using monitor::Fault;
using monitor::Ne107;

std::vector<Trouble> troubles_of(const ValveView& valve, bool stalled) {
  std::vector<Trouble> out;
  if (stalled) out.push_back({std::string(no_samples), Ne107::function_check});
  if (valve.condition == Ne107::good) return out;
  const bool decided =
      valve.doubted ||
      std::any_of(valve.indicators.begin(), valve.indicators.end(),
                  [](const monitor::Indicator& one) { return one.state == monitor::IndicatorState::raised; }) ||
      std::any_of(valve.causes.begin(), valve.causes.end(),
                  [](const monitor::Cause& one) { return one.fault == Fault::wrong_model; });
  Ne107 explained = Ne107::good;
  for (const monitor::Cause& cause : valve.causes) {
    // What the status alone states is certain.
    const bool failed = valve.condition == Ne107::failure && cause.odds >= monitor::most_odds;
    if (!decided && !failed) continue;
    const Ne107 sign = failed ? Ne107::failure : monitor::sign_of(cause.fault);
    explained = std::max(explained, sign);
    out.push_back({std::string(monitor::name(cause.fault)), sign, cause.odds});
  }
  if (explained >= valve.condition) return out;
  // No cause is reported: the share of time of a status made the sign, or the charts did, and nothing explains them.
  switch (valve.condition) {
    case Ne107::maintenance_required:
      out.push_back({"maintenance_required", valve.condition});
      break;
    case Ne107::out_of_specification:
      out.push_back({"out_of_specification", valve.condition});
      break;
    case Ne107::function_check:
      out.push_back({"function_check", valve.condition});
      break;
    case Ne107::failure:
      out.push_back({"failure", valve.condition});
      break;
    case Ne107::good:
      break;
  }
  return out;
}

}  // namespace spoolflow::live
