#pragma once
/// The whole fleet as it stands: valves with what is wrong with them, sites, and each indicator over the valves of a
/// series. Made of what the database holds; knows no database itself.
#include <array>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "addons/fleet/page/series_spread.hpp"
#include "addons/fleet/store/alarm_desk.hpp"
#include "addons/fleet/store/fleet_view.hpp"

namespace spoolflow::fleet {

/// No block was committed for so long [s]: nothing is known of the valve now.
inline constexpr double silent_after_s = 30;

struct ShownValve {
  ValveNow now;
  std::string site{}, series{};  ///< series: the name that its model gives the valve
  std::string sign = "good";     ///< NE 107: the worst of its alarms that are not gone
  int alarms = 0, unacknowledged = 0;
  [[nodiscard]] bool silent() const { return now.age_s > silent_after_s; }
};

struct ShownSite {
  std::string site;
  int valves = 0, silent = 0, alarms = 0, unacknowledged = 0;
  std::map<std::string, int> signs{};  ///< valves by their sign
  double flow_m3_per_s = 0;            ///< mean of the last block, summed over the valves that are not silent
};

/// NE 107: 0 good, 1 maintenance, 2 out of specification, 3 check, 4 failure.
[[nodiscard]] int severity(std::string_view sign);
/// `series`: by model hash. `alarms`: those that are not cleared, at least.
[[nodiscard]] std::vector<ShownValve> shown_valves(std::vector<ValveNow> valves, const std::vector<live::Alarm>& alarms,
                                                   const std::map<std::string, std::string>& series);
/// By name.
[[nodiscard]] std::vector<ShownSite> shown_sites(const std::vector<ShownValve>& valves);

/// One indicator over all valves of a series. Counters and what is not known are left out.
struct Distribution {
  struct Row {
    std::string valve;
    ValveFigure figure;
    std::string state;
  };
  std::string unit{};
  std::vector<Row> rows{};  ///< as the valves are ordered
  SeriesSpread spread{};
};
/// By series and indicator.
using Distributions = std::map<std::pair<std::string, std::string>, Distribution>;
[[nodiscard]] Distributions distributions(const std::vector<ShownValve>& valves,
                                          const std::vector<IndicatorNow>& indicators);

}  // namespace spoolflow::fleet
