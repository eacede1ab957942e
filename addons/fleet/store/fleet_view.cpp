#include "addons/fleet/store/fleet_view.hpp"

#include <cmath>

namespace spoolflow::fleet {
namespace {

std::uint64_t counted(const Rows& rows, int row, int column) {
  return static_cast<std::uint64_t>(rows.integer(row, column));
}

}  // namespace

std::vector<ValveNow> valves_now(Session& session) {
  const Rows rows = session.run(
      "SELECT number, id, model, coverage.wall_ms, extract(epoch FROM now() - committed)::float8, state.samples, "
      "state.energy_J, last.samples, time_s, flow_min, flow_mean, flow_max, lower_min, upper_max, last.energy_J, "
      "status "
      "FROM valve JOIN coverage ON coverage.valve = number LEFT JOIN state ON state.valve = number LEFT JOIN LATERAL "
      "(SELECT * FROM second WHERE second.valve = number ORDER BY session DESC, block DESC LIMIT 1) last ON true "
      "ORDER BY id");
  std::vector<ValveNow> out;
  out.reserve(static_cast<std::size_t>(rows.size()));
  for (int row = 0; row < rows.size(); ++row) {
    ValveNow now{.number = rows.integer(row, 0), .id = rows.text(row, 1), .model_sha256 = rows.text(row, 2)};
    now.wall_ms = rows.integer(row, 3);
    now.age_s = rows.real(row, 4);
    now.samples = counted(rows, row, 5);
    now.energy_J = rows.real(row, 6);
    now.last = {rows.integer(row, 7), rows.real(row, 8),  rows.real(row, 9),
                rows.real(row, 10),   rows.real(row, 11), rows.real(row, 12),
                rows.real(row, 13),   rows.real(row, 14), static_cast<std::uint32_t>(rows.integer(row, 15))};
    out.push_back(std::move(now));
  }
  return out;
}

std::optional<std::int64_t> valve_number(Session& session, const std::string& valve) {
  const Rows row = session.run("SELECT number FROM valve WHERE id = $1", Values().put(std::string_view(valve)));
  return row.size() == 0 ? std::nullopt : std::optional(row.integer(0, 0));
}

std::vector<IndicatorNow> indicators_now(Session& session) {
  const Rows rows = session.run(
      "SELECT number, name, value, uncertainty_95, baseline, state, unit FROM valve JOIN LATERAL "
      "(SELECT session, block FROM indicator WHERE valve = number ORDER BY session DESC, block DESC LIMIT 1) newest ON "
      "true JOIN indicator ON indicator.valve = number AND indicator.session = newest.session AND indicator.block = "
      "newest.block ORDER BY id, name");
  std::vector<IndicatorNow> out;
  out.reserve(static_cast<std::size_t>(rows.size()));
  for (int row = 0; row < rows.size(); ++row) {
    out.push_back({rows.integer(row, 0),
                   {rows.text(row, 1), rows.real(row, 2), rows.real(row, 3), rows.real(row, 4), rows.text(row, 5),
                    rows.text(row, 6)}});
  }
  return out;
}

std::optional<std::vector<std::uint8_t>> packed_model(Session& session, const std::string& sha256) {
  const Rows row = session.run("SELECT content FROM model WHERE sha256 = $1", Values().put(std::string_view(sha256)));
  if (row.size() == 0) return std::nullopt;
  return row.bytes(0, 0);
}

std::vector<live::Event> fleet_events(Session& session, const std::string& valve, int most) {
  const Rows rows = session.run(
      "SELECT id, wall_ms, valve, time_s, kind, text FROM event WHERE $1 = '' OR valve = $1 ORDER BY id DESC LIMIT "
      "$2::bigint",
      Values().put(std::string_view(valve)).put(std::int64_t{most}));
  std::vector<live::Event> out;
  for (int row = 0; row < rows.size(); ++row) {
    out.push_back({rows.integer(row, 0), rows.integer(row, 1), rows.text(row, 2), rows.real(row, 3), rows.text(row, 4),
                   rows.text(row, 5)});
  }
  return out;
}

std::vector<live::FlowPoint> flow_days(Session& session, std::int64_t valve, const live::Span& span) {
  const Rows rows = session.run(
      "WITH lasting AS (SELECT *, time_s - lag(time_s) OVER (ORDER BY wall_ms) AS since_s FROM second "
      "WHERE valve = $1 AND wall_ms >= $2 AND wall_ms < $3) "
      "SELECT avg(wall_ms)::bigint, avg(flow_mean), min(flow_min), max(flow_max), min(lower_min), max(upper_max), "
      "sum(energy_J) / sum(CASE WHEN since_s > 0 AND since_s <= 0.01 * samples THEN since_s ELSE 1 END) "
      "FROM lasting GROUP BY wall_ms / $4::bigint ORDER BY 1",
      Values().put(valve).put(span.from_ms).put(span.to_ms).put(live::point_width_ms(span, live::least_flow_width_ms)));
  std::vector<live::FlowPoint> out;
  for (int row = 0; row < rows.size(); ++row) {
    out.push_back({rows.integer(row, 0), rows.real(row, 1), rows.real(row, 2), rows.real(row, 3), rows.real(row, 4),
                   rows.real(row, 5), rows.real(row, 6)});
  }
  return out;
}

std::vector<KeptDays> indicator_days(Session& session, std::int64_t valve, const live::Span& span) {
  const Rows rows = session.run(
      "SELECT name, max(unit), avg(wall_ms)::bigint AS at, avg(value), min(value), max(value), avg(uncertainty_95), "
      "avg(baseline), bool_or(state = 'raised')::int FROM indicator WHERE valve = $1 AND wall_ms >= $2 AND wall_ms < "
      "$3 "
      "AND state != 'counts' GROUP BY name, wall_ms / $4::bigint ORDER BY name, at",
      Values()
          .put(valve)
          .put(span.from_ms)
          .put(span.to_ms)
          .put(live::point_width_ms(span, live::least_indicator_width_ms)));
  std::vector<KeptDays> out;
  for (int row = 0; row < rows.size(); ++row) {
    if (out.empty() || out.back().name != rows.text(row, 0)) out.push_back({rows.text(row, 0), rows.text(row, 1)});
    out.back().points.push_back({rows.integer(row, 2), rows.real(row, 3), rows.real(row, 4), rows.real(row, 5),
                                 rows.real(row, 6), rows.real(row, 7), rows.integer(row, 8) != 0});
  }
  return out;
}

}  // namespace spoolflow::fleet
