#include "spoolflow/live/page/answer.hpp"

#include <charconv>
#include <utility>

#include "spoolflow/live/page/api_text.hpp"
#include "spoolflow/live/page/page_files.hpp"
#include "spoolflow/live/page/target.hpp"

namespace spoolflow::live {
namespace {

using media::json;
using media::plain;

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

/// /api/v1/valves/ID/indicators and /api/v1/valves/ID/history; nothing where it is neither.
std::optional<PageAnswer> days_of(const Engine& engine, std::string_view path, std::string_view target) {
  const auto indicators = valve_asked(path, "indicators");
  const auto asked = indicators ? indicators : valve_asked(path, "history");
  if (!asked) return std::nullopt;
  const auto valve = place_of(engine, *asked);
  if (!valve) return PageAnswer{404, plain, "there is no valve of this name\n"};
  constexpr std::int64_t day_ms = 86'400'000;
  const auto instant = [&](std::string_view key, std::int64_t otherwise) {
    const auto text = query_value(target, key);
    return text ? instant_ms(*text) : std::optional(otherwise);
  };
  const auto to_ms = instant("to", wall_ms());
  const auto from_ms = instant("from", to_ms.value_or(0) - day_ms);
  if (!to_ms || !from_ms || *from_ms >= *to_ms) {
    return PageAnswer{400, plain,
                      "from and to are instants such as 2026-11-22T10:30:00Z or seconds since 1970, from before to\n"};
  }
  const Span span{*from_ms, *to_ms};
  return PageAnswer{
      200, json, indicators ? indicator_history_json(engine, *valve, span) : flow_history_json(engine, *valve, span)};
}

}  // namespace

PageAnswer answer_to(const Engine& engine, std::string_view method, std::string_view target) {
  if (method != "GET" && method != "HEAD") return {405, plain, "only GET is answered\n"};
  const std::string_view path = target.substr(0, target.find('?'));
  try {
    if (auto days = days_of(engine, path, target)) return std::move(*days);
    return found(engine, path);
  } catch (const StoreError& error) {
    return {503, plain, std::string(error.what()) + "\n"};
  }
}

namespace {

PageAnswer found(const Engine& engine, std::string_view path) {
  if (path == "/") return {200, "text/html; charset=utf-8", page_file("live.html")};
  if (path == "/live.js") return {200, "text/javascript; charset=utf-8", page_file("live.js")};
  if (path == "/live.css") return {200, "text/css; charset=utf-8", page_file("live.css")};
  if (path == "/api/v1/valves") return {200, json, valves_json(engine)};
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

std::optional<std::size_t> streamed_valve(const Engine& engine, std::string_view target) {
  const auto asked = valve_asked(target, "stream");
  return asked ? place_of(engine, *asked) : std::nullopt;
}

bool is_page_file(std::string_view path) {
  return path == "/" || path == "/live.js" || path == "/live.css";
}

}  // namespace spoolflow::live
