/// Days of a valve as JSON: a column each figure, so that they are short and ready to plot.
#include "spoolflow/live/page/api_text.hpp"
#include "spoolflow/live/page/json_text.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::live {
namespace {

/// Numbers with as many digits as their spread deserves.
Json six_digits(double value) {
  if (!std::isfinite(value)) return nullptr;
  return Json::parse(fmt::format("{:.6g}", value));
}

template <class Points, class Value>
Json column(const Points& points, Value&& value) {
  Json out = Json::array();
  for (const auto& point : points) out.push_back(value(point));
  return out;
}

}  // namespace

std::string indicator_history_json(const Engine& engine, std::size_t valve, const Span& span) {
  Json out = Json::array();
  const ValveView view = engine.view(valve);
  IndicatorHistories kept;
  if (!engine.site().store.empty()) kept = read_indicators(engine.site().store, view.id, span);
  for (const monitor::Indicator& one : view.indicators) {  // in the monitor's order
    if (one.state == monitor::IndicatorState::counts) continue;
    const std::vector<IndicatorPoint>& points = kept[std::string(one.name)];
    if (points.empty()) continue;
    using Point = IndicatorPoint;
    out.push_back({{"name", one.name},
                   {"unit", one.unit},
                   {"time_ms", column(points, [](const Point& p) { return Json(p.wall_ms); })},
                   {"value", column(points, [](const Point& p) { return six_digits(p.value); })},
                   {"smallest", column(points, [](const Point& p) { return six_digits(p.smallest); })},
                   {"largest", column(points, [](const Point& p) { return six_digits(p.largest); })},
                   {"uncertainty_95", column(points, [](const Point& p) { return six_digits(p.uncertainty_95); })},
                   {"baseline", column(points, [](const Point& p) { return six_digits(p.baseline); })},
                   {"raised", column(points, [](const Point& p) { return Json(p.raised); })}});
  }
  return written(
      Json{{"valve", view.id}, {"from", utc(span.from_ms)}, {"to", utc(span.to_ms)}, {"indicators", std::move(out)}});
}

std::string flow_history_json(const Engine& engine, std::size_t valve, const Span& span) {
  const std::string& id = engine.valve(valve).id();
  std::vector<FlowPoint> points;
  if (!engine.site().store.empty()) points = read_flow(engine.site().store, id, span);
  using Point = FlowPoint;
  const auto flow = [](double m3_per_s) { return six_digits(m3_per_s * units::litre_per_minute_per_m3_per_s); };
  return written(Json{{"valve", id},
                      {"from", utc(span.from_ms)},
                      {"to", utc(span.to_ms)},
                      {"time_ms", column(points, [](const Point& p) { return Json(p.wall_ms); })},
                      {"flow_mean_L_min", column(points, [&](const Point& p) { return flow(p.mean_m3_per_s); })},
                      {"flow_min_L_min", column(points, [&](const Point& p) { return flow(p.smallest_m3_per_s); })},
                      {"flow_max_L_min", column(points, [&](const Point& p) { return flow(p.largest_m3_per_s); })},
                      {"flow_lower_L_min", column(points, [&](const Point& p) { return flow(p.lower_m3_per_s); })},
                      {"flow_upper_L_min", column(points, [&](const Point& p) { return flow(p.upper_m3_per_s); })},
                      {"power_W", column(points, [](const Point& p) { return six_digits(p.power_W); })}});
}

}  // namespace spoolflow::live
