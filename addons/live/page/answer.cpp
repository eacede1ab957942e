#include "addons/live/page/answer.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <iterator>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "addons/live/http/target.hpp"
#include "addons/live/page/alarm_orders.hpp"
#include "addons/live/page/api_text.hpp"
#include "addons/live/page/history_text.hpp"
#include "addons/live/page/model_text.hpp"
#include "addons/live/page/page_files.hpp"
#include "addons/live/page/plot_frame.hpp"

namespace spoolflow::live {
namespace {

using media::json;
using media::plain;

/// Of the days of a valve for one answer.
constexpr std::chrono::seconds longest_reading{20};

std::string page_file(std::string_view name) {
  for (const EmbeddedFile& file : page_files()) {
    if (file.name == name) return std::string(file.bytes);
  }
  return {};
}

/// The number of /api/v1/recordings/NUMBER.csv.
std::optional<std::int64_t> recording_asked(std::string_view path) {
  constexpr std::string_view before = "/api/v1/recordings/", behind = ".csv";
  if (!path.starts_with(before) || !path.ends_with(behind)) return std::nullopt;
  if (path.size() <= before.size() + behind.size()) return std::nullopt;
  path = path.substr(before.size(), path.size() - before.size() - behind.size());
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(path.data(), path.data() + path.size(), number);
  return error == std::errc() && end == path.data() + path.size() ? std::optional(number) : std::nullopt;
}

PageAnswer recording_answer(const Engine& engine, std::int64_t number) {
  const auto recording = engine.site().store.empty() ? std::nullopt : read_recording(engine.site().store, number);
  if (!recording) return {404, plain, "there is no recording of this number\n"};
  return {200, media::csv, recording->csv};
}

PageAnswer found(const Engine& engine, std::string_view path);

std::optional<std::size_t> place_of(const Engine& engine, std::string_view id) {
  for (std::size_t k = 0; k < engine.size(); ++k) {
    if (engine.valve(k).id() == id) return k;
  }
  return std::nullopt;
}

/// Piece by piece, so that one request takes no more than its time. False where it ended before the last piece. Points
/// lie where they would in one piece.
template <class Read>
bool read_pieces(const Span& span, std::int64_t least_width_ms, const std::stop_token& stop, Read&& read) {
  constexpr std::int64_t points_of_a_piece = 20;
  const auto end = std::chrono::steady_clock::now() + longest_reading;
  const std::int64_t width_ms = point_width_ms(span, least_width_ms), piece_ms = points_of_a_piece * width_ms;
  for (std::int64_t from_ms = span.from_ms; from_ms < span.to_ms;) {
    if (stop.stop_requested() || std::chrono::steady_clock::now() > end) return false;
    const std::int64_t to_ms = std::min(span.to_ms, (from_ms / piece_ms + 1) * piece_ms);
    read(Span{from_ms, to_ms, span.most_points, width_ms});
    from_ms = to_ms;
  }
  return true;
}

PageAnswer too_long() {
  return {503, plain,
          fmt::format("this span takes longer than {} s to read; ask for a shorter one\n", longest_reading.count())};
}

template <class Point>
void append(std::vector<Point>& to, std::vector<Point>&& more) {
  to.insert(to.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

PageAnswer indicator_days(const Engine& engine, std::size_t valve, const Span& span, const std::stop_token& stop) {
  const ValveView view = engine.view(valve);
  const std::string& store = engine.site().store;
  IndicatorHistories kept;
  const bool whole = store.empty() || read_pieces(span, least_indicator_width_ms, stop, [&](const Span& piece) {
                       for (auto& [name, points] : read_indicators(store, view.id, piece))
                         append(kept[name], std::move(points));
                     });
  if (!whole) return too_long();
  std::vector<IndicatorDays> out;
  for (const monitor::Indicator& one : view.indicators) {  // in the monitor's order
    std::vector<IndicatorPoint>& points = kept[std::string(one.name)];
    if (one.state == monitor::IndicatorState::counts || points.empty()) continue;
    out.push_back({std::string(one.name), std::string(one.unit), std::move(points)});
  }
  return {200, json, indicator_days_json(view.id, span, out)};
}

PageAnswer flow_days(const Engine& engine, std::size_t valve, const Span& span, const std::stop_token& stop) {
  const std::string& id = engine.valve(valve).id();
  const std::string& store = engine.site().store;
  std::vector<FlowPoint> points;
  const bool whole = store.empty() || read_pieces(span, least_flow_width_ms, stop, [&](const Span& piece) {
                       append(points, read_flow(store, id, piece));
                     });
  if (!whole) return too_long();
  return {200, json, flow_days_json(id, span, points)};
}

constexpr std::string_view recent_path = "/api/v1/recent";

/// Of every valve what the store has of the last seconds; where that takes too long, of those that were read until
/// then.
PageAnswer recent_flows(const Engine& engine, const std::stop_token& stop) {
  const auto end = std::chrono::steady_clock::now() + longest_reading;
  const std::int64_t to_ms = wall_ms() / 1000 * 1000, from_ms = to_ms - 1000 * recent_seconds;
  const std::string& store = engine.site().store;
  std::vector<RecentFlow> out;
  for (std::size_t k = 0; k < engine.size() && !store.empty(); ++k) {
    if (stop.stop_requested() || std::chrono::steady_clock::now() > end) break;
    const std::string& id = engine.valve(k).id();
    out.push_back({id, read_flow(store, id, {from_ms, to_ms, recent_seconds, least_flow_width_ms})});
  }
  return {200, json, recent_json(from_ms, out)};
}

/// /api/v1/valves/ID/indicators and /api/v1/valves/ID/history; nothing where it is neither.
std::optional<PageAnswer> days_of(const Engine& engine, std::string_view path, std::string_view target,
                                  const std::stop_token& stop) {
  const auto indicators = valve_asked(path, "indicators");
  const auto asked = indicators ? indicators : valve_asked(path, "history");
  if (!asked) return std::nullopt;
  const auto valve = place_of(engine, *asked);
  if (!valve) return PageAnswer{404, plain, "there is no valve of this name\n"};
  const auto span = span_asked(target);
  if (!span) return no_span();
  return indicators ? indicator_days(engine, *valve, *span, stop) : flow_days(engine, *valve, *span, stop);
}

/// /api/v1/valves/ID/model; nothing where it is another path.
std::optional<PageAnswer> model_asked(const Engine& engine, std::string_view path) {
  const auto asked = valve_asked(path, "model");
  if (!asked) return std::nullopt;
  const auto valve = place_of(engine, *asked);
  return valve ? PageAnswer{200, json, model_json(engine, *valve)}
               : PageAnswer{404, plain, "there is no valve of this name\n"};
}

/// What reads the store.
bool is_long(std::string_view path) {
  return valve_asked(path, "indicators") || valve_asked(path, "history") || path.starts_with("/api/v1/recordings") ||
         path == recent_path;
}

}  // namespace

PageAnswer answer_to(const Engine& engine, std::string_view method, std::string_view target,
                     const std::stop_token& stop) {
  if (method != "GET" && method != "HEAD") return {405, plain, "only GET is answered\n"};
  const std::string_view path = target.substr(0, target.find('?'));
  try {
    if (path == recent_path) return recent_flows(engine, stop);
    if (auto days = days_of(engine, path, target, stop)) return std::move(*days);
    return found(engine, path);
  } catch (const StoreError& error) {
    return {503, plain, std::string(error.what()) + "\n"};
  }
}

namespace {

/// The valve of /api/v1/valves/ID, whether there is one or not.
std::optional<std::string_view> valve_alone(std::string_view path) {
  constexpr std::string_view before = "/api/v1/valves/";
  if (!path.starts_with(before) || path.size() == before.size()) return std::nullopt;
  path.remove_prefix(before.size());
  return path.find('/') == std::string_view::npos ? std::optional(path) : std::nullopt;
}

PageAnswer found(const Engine& engine, std::string_view path) {
  if (path == "/") return {200, "text/html; charset=utf-8", page_file("live.html")};
  if (path == "/live.js") return {200, "text/javascript; charset=utf-8", page_file("live.js")};
  if (path == "/live.css") return {200, "text/css; charset=utf-8", page_file("live.css")};
  if (path == "/api/v1/valves") return {200, json, valves_json(engine)};
  if (const auto id = valve_alone(path)) {
    const auto valve = place_of(engine, *id);
    if (!valve) return {404, plain, "there is no valve of this name\n"};
    return {200, json, valve_json(engine, *valve)};
  }
  if (auto model = model_asked(engine, path)) return std::move(*model);
  if (path == "/api/v1/events") return {200, json, events_json(engine)};
  if (path == "/api/v1/alarms") return {200, json, alarms_json(engine)};
  if (path == "/api/v1/recordings") return {200, json, recordings_json(engine)};
  if (const auto number = recording_asked(path)) return recording_answer(engine, *number);
  if (path == "/api/v1/site") return {200, json, site_json(engine)};
  if (path == "/api/v1/openapi.json") return {200, json, page_file("openapi.json")};
  if (path == "/metrics") return {200, "text/plain; version=0.0.4; charset=utf-8", metrics_text(engine)};
  return {404, plain, "there is nothing here; see /, /api/v1/valves, /api/v1/events, /api/v1/site and /metrics\n"};
}

}  // namespace

namespace {

/// With each message what came since the one before.
NextFrame plot_of(const ValveAtWork& valve) {
  return [&valve, next = std::uint64_t{0}]() mutable {
    const ValveAtWork::TracePart part = valve.trace_from(next);
    next = part.first + part.points.size();
    if (next > 0) --next;  // the last point may still grow
    return plot_frame(part, steady_ns());
  };
}

}  // namespace

PageContent site_page(Engine& engine) {
  return {.name = "spoolflow live",
          .answer = [&](std::string_view method, std::string_view target) { return answer_to(engine, method, target); },
          .is_file = [](std::string_view path) { return path == "/" || path == "/live.js" || path == "/live.css"; },
          .act = [&](const AlarmOrder& order, const std::string& by) { return act_on_alarm(engine, order, by); },
          .stream =
              [&](std::string_view path) {
                const auto asked = valve_asked(path, "stream");
                const auto valve = asked ? place_of(engine, *asked) : std::nullopt;
                return valve ? plot_of(engine.valve(*valve)) : NextFrame();
              },
          .is_long = is_long,
          .long_answer = [&](std::string_view method, std::string_view target,
                             const std::stop_token& stop) { return answer_to(engine, method, target, stop); }};
}

}  // namespace spoolflow::live
