#include "addons/live/history/long_history.hpp"

#include <algorithm>
#include <optional>

#include "addons/live/history/store.hpp"

namespace spoolflow::live {

std::int64_t point_width_ms(const Span& span, std::int64_t least_ms) {
  if (span.width_ms > 0) return span.width_ms;
  return std::max(least_ms, (span.to_ms - span.from_ms) / std::max<std::int64_t>(1, span.most_points));
}

namespace {

/// By itself, and bound to what follows: where a view is asked for the valve that another query names, SQLite reads the
/// rows of all valves and times.
std::optional<std::int64_t> number_of(Database& database, const std::string& valve) {
  Statement number(database, "SELECT number FROM valve WHERE id = ?");
  number.put(std::string_view(valve));
  return number.next() ? std::optional(number.integer(0)) : std::nullopt;
}

}  // namespace

IndicatorHistories read_indicators(const std::string& path, const std::string& valve, const Span& span) {
  Database database = open_store_to_read(path);
  const auto number = number_of(database, valve);
  if (!number) return {};
  Statement rows(database,
                 "SELECT name, CAST(avg(wall_ms) AS INTEGER) AS at, avg(value), min(value), max(value), "
                 "avg(uncertainty_95), avg(baseline), max(state = 'raised') FROM indicator WHERE valve = ? "
                 "AND wall_ms >= ? AND wall_ms < ? GROUP BY name, wall_ms / ? ORDER BY name, at");
  rows.put(*number).put(span.from_ms).put(span.to_ms).put(point_width_ms(span, least_indicator_width_ms));
  IndicatorHistories out;
  while (rows.next()) {
    out[rows.text(0)].push_back(
        {rows.integer(1), rows.real(2), rows.real(3), rows.real(4), rows.real(5), rows.real(6), rows.integer(7) != 0});
  }
  return out;
}

std::vector<FlowPoint> read_flow(const std::string& path, const std::string& valve, const Span& span) {
  Database database = open_store_to_read(path);
  const auto number = number_of(database, valve);
  if (!number) return {};
  // A row holds what came in one second of the clock: of a source that lags, or replays, other than one of its own.
  Statement rows(database,
                 "WITH lasting AS (SELECT *, time_s - lag(time_s) OVER (ORDER BY wall_ms) AS since_s FROM second "
                 "WHERE valve = ? AND wall_ms >= ? AND wall_ms < ?) "
                 "SELECT CAST(avg(wall_ms) AS INTEGER), avg(flow_mean), min(flow_min), max(flow_max), min(lower_min), "
                 "max(upper_max), "
                 "sum(energy_J) / sum(CASE WHEN since_s > 0 AND since_s <= 0.01 * samples THEN since_s ELSE 1 END) "
                 "FROM lasting GROUP BY wall_ms / ? ORDER BY 1");
  rows.put(*number).put(span.from_ms).put(span.to_ms).put(point_width_ms(span, least_flow_width_ms));
  std::vector<FlowPoint> out;
  while (rows.next()) {
    out.push_back(
        {rows.integer(0), rows.real(1), rows.real(2), rows.real(3), rows.real(4), rows.real(5), rows.real(6)});
  }
  return out;
}

}  // namespace spoolflow::live
