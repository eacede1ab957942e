#include "addons/live/page/history_text.hpp"

#include <fmt/format.h>

#include "addons/live/engine.hpp"
#include "addons/live/http/json_text.hpp"
#include "addons/live/http/target.hpp"
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

std::optional<Span> span_asked(std::string_view target) {
  constexpr std::int64_t day_ms = 86'400'000;
  const auto instant = [&](std::string_view key, std::int64_t otherwise) {
    const auto text = query_value(target, key);
    return text ? instant_ms(*text) : std::optional(otherwise);
  };
  const auto to_ms = instant("to", wall_ms());
  const auto from_ms = instant("from", to_ms.value_or(0) - day_ms);
  if (!to_ms || !from_ms || *from_ms >= *to_ms) return std::nullopt;
  return Span{*from_ms, *to_ms};
}

PageAnswer no_span() {
  return {400, media::plain,
          "from and to are instants such as 2026-11-22T10:30:00Z or seconds since 1970, from before to\n"};
}

std::string indicator_days_json(const std::string& valve, const Span& span,
                                const std::vector<IndicatorDays>& indicators) {
  Json out = Json::array();
  for (const IndicatorDays& one : indicators) {
    using Point = IndicatorPoint;
    const std::vector<IndicatorPoint>& points = one.points;
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
      Json{{"valve", valve}, {"from", utc(span.from_ms)}, {"to", utc(span.to_ms)}, {"indicators", std::move(out)}});
}

std::string recent_json(std::int64_t from_ms, const std::vector<RecentFlow>& valves) {
  Json out = Json::array();
  for (const RecentFlow& valve : valves) {
    std::vector<const FlowPoint*> seconds(static_cast<std::size_t>(recent_seconds), nullptr);
    for (const FlowPoint& point : valve.points) {
      const std::int64_t second = (point.wall_ms - from_ms) / 1000;
      if (second >= 0 && second < recent_seconds) seconds[static_cast<std::size_t>(second)] = &point;
    }
    const auto flows = [&](double FlowPoint::*member) {
      return column(seconds, [&](const FlowPoint* point) {
        return point == nullptr ? Json(nullptr) : six_digits(point->*member * units::litre_per_minute_per_m3_per_s);
      });
    };
    out.push_back({{"id", valve.valve},
                   {"flow_L_min", flows(&FlowPoint::mean_m3_per_s)},
                   {"flow_lower_L_min", flows(&FlowPoint::lower_m3_per_s)},
                   {"flow_upper_L_min", flows(&FlowPoint::upper_m3_per_s)}});
  }
  return written(Json{{"step_s", 1}, {"from", utc(from_ms)}, {"valves", std::move(out)}});
}

std::string flow_days_json(const std::string& valve, const Span& span, const std::vector<FlowPoint>& points) {
  using Point = FlowPoint;
  const auto flow = [](double m3_per_s) { return six_digits(m3_per_s * units::litre_per_minute_per_m3_per_s); };
  return written(Json{{"valve", valve},
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
