#pragma once
/// What the page of a fleet answers, as text. Formats: docs/fleet.md.
#include <string>
#include <vector>

#include "addons/fleet/page/fleet_now.hpp"
#include "addons/fleet/store/partitions.hpp"

namespace spoolflow::fleet {

/// What of the valves is asked for; empty: all.
struct ValveFilter {
  std::string site{}, series{};
  std::string search{};  ///< part of the id, of any case
};
/// JSON of /api/v1/valves: {"valves": [...]}.
[[nodiscard]] std::string valves_json(const std::vector<ShownValve>& valves, const ValveFilter& filter);
/// JSON of /api/v1/sites: {"sites": [...]}.
[[nodiscard]] std::string sites_json(const std::vector<ShownSite>& sites);
/// JSON of /api/v1/alarms: {"alarms": [...]}, as they come.
[[nodiscard]] std::string alarms_json(const std::vector<live::Alarm>& alarms);
[[nodiscard]] std::string alarm_json(const live::Alarm& alarm);
/// JSON of /api/v1/events: {"events": [...]}, as they come.
[[nodiscard]] std::string events_json(const std::vector<live::Event>& events);
/// JSON of /api/v1/series: {"series": [...]}, each indicator with its median, scale and outliers.
[[nodiscard]] std::string series_json(const Distributions& distributions);
/// JSON of /api/v1/distribution: a column each figure.
[[nodiscard]] std::string distribution_json(const Distribution& distribution);
/// JSON of /api/v1/partitions: {"partitions": [...]}.
[[nodiscard]] std::string partitions_json(const std::vector<PartitionStatus>& partitions);
/// Prometheus text format 0.0.4 of /metrics.
[[nodiscard]] std::string metrics_text(const std::vector<ShownSite>& sites,
                                       const std::vector<PartitionStatus>& partitions);

}  // namespace spoolflow::fleet
