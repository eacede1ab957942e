#include "spoolflow/live/page/answer.hpp"

#include <algorithm>
#include <charconv>

#include "spoolflow/live/page/api_text.hpp"
#include "spoolflow/live/page/page_files.hpp"

namespace spoolflow::live {
namespace {

constexpr std::string_view json = "application/json";
constexpr std::string_view plain = "text/plain; charset=utf-8";

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
  return {200, "text/csv; charset=utf-8", recording->csv};
}

PageAnswer found(const Engine& engine, std::string_view path);

}  // namespace

PageAnswer answer_to(const Engine& engine, std::string_view method, std::string_view target) {
  if (method != "GET" && method != "HEAD") return {405, plain, "only GET is answered\n"};
  const std::string_view path = target.substr(0, target.find('?'));
  try {
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
  if (path == "/api/v1/recordings") return {200, json, recordings_json(engine)};
  if (const auto number = recording_asked(path)) return recording_answer(engine, *number);
  if (path == "/api/v1/site") return {200, json, site_json(engine)};
  if (path == "/api/v1/openapi.json") return {200, json, page_file("openapi.json")};
  if (path == "/metrics") return {200, "text/plain; version=0.0.4; charset=utf-8", metrics_text(engine)};
  return {404, plain, "there is nothing here; see /, /api/v1/valves, /api/v1/events, /api/v1/site and /metrics\n"};
}

}  // namespace

std::optional<std::size_t> streamed_valve(const Engine& engine, std::string_view target) {
  constexpr std::string_view before = "/api/v1/valves/", behind = "/stream";
  if (!target.starts_with(before) || !target.ends_with(behind)) return std::nullopt;
  if (target.size() <= before.size() + behind.size()) return std::nullopt;
  const std::string_view id = target.substr(before.size(), target.size() - before.size() - behind.size());
  for (std::size_t k = 0; k < engine.size(); ++k) {
    if (engine.valve(k).id() == id) return k;
  }
  return std::nullopt;
}

bool is_own_host(std::string_view host) {
  const std::size_t colon = host.rfind(':');
  const bool has_port = colon != std::string_view::npos && host.find(']', colon) == std::string_view::npos;
  const std::string_view name = has_port ? host.substr(0, colon) : host;
  return name == "localhost" || name == "[::1]" ||
         (name.starts_with("127.") && name.size() <= 15 &&
          std::all_of(name.begin(), name.end(), [](char c) { return c == '.' || (c >= '0' && c <= '9'); }));
}

bool is_own_origin(std::string_view origin, std::string_view host) {
  constexpr std::string_view scheme = "http://";
  return origin.empty() || (origin.starts_with(scheme) && origin.substr(scheme.size()) == host);
}

}  // namespace spoolflow::live
