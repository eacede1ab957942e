#pragma once
/// Days of a valve as JSON: a column each figure, so that they are short and ready to plot. Of one machine's store or
/// of a fleet's. Formats: docs/live.md.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "addons/live/history/long_history.hpp"
#include "addons/live/http/request.hpp"

namespace spoolflow::live {

/// What ?from=…&to=… asks for; without them the last day. Nothing where they are no instants in their order.
[[nodiscard]] std::optional<Span> span_asked(std::string_view target);
/// The answer to such ones.
[[nodiscard]] PageAnswer no_span();

struct IndicatorDays {
  std::string name, unit;
  std::vector<IndicatorPoint> points;
};
/// JSON of /api/v1/valves/ID/indicators.
[[nodiscard]] std::string indicator_days_json(const std::string& valve, const Span& span,
                                              const std::vector<IndicatorDays>& indicators);
/// So many seconds of every valve, for pages that begin with them.
inline constexpr std::int64_t recent_seconds = 120;
struct RecentFlow {
  std::string valve;
  std::vector<FlowPoint> points;  ///< of the seconds from `from_ms` on
};
/// JSON of /api/v1/recent: of each valve the flow and its band, a number a second from that instant on; null: none
/// kept.
[[nodiscard]] std::string recent_json(std::int64_t from_ms, const std::vector<RecentFlow>& valves);
/// JSON of /api/v1/valves/ID/history.
[[nodiscard]] std::string flow_days_json(const std::string& valve, const Span& span,
                                         const std::vector<FlowPoint>& points);

}  // namespace spoolflow::live
