#include "addons/fleet/page/fleet_page.hpp"

#include <algorithm>
#include <charconv>

#include "addons/fleet/models.hpp"
#include "addons/fleet/page/fleet_page_files.hpp"
#include "addons/fleet/page/fleet_text.hpp"
#include "addons/live/http/target.hpp"
#include "addons/live/page/alarm_orders.hpp"
#include "addons/live/page/history_text.hpp"
#include "addons/live/valve/events.hpp"
#include "spoolflow/model/model_error.hpp"

namespace spoolflow::fleet {
namespace {

using live::PageAnswer;
using live::media::json;
using live::media::plain;

/// However many look: the whole of it is read no more often than so. Indicators are kept once a minute.
constexpr std::chrono::seconds valves_hold{2}, spread_holds{20};
/// A server that takes longer counts as away.
constexpr std::chrono::seconds answers_within{20};
constexpr int shown_cleared = 200, shown_events = 200;

std::string page_file(std::string_view name) {
  for (const live::EmbeddedFile& file : live::fleet_page_files()) {
    if (file.name == name) return std::string(file.bytes);
  }
  return {};
}

bool is_page_file(std::string_view path) {
  return path == "/" || path == "/fleet.js" || path == "/fleet.css";
}

PageAnswer no_such_text() {
  return {400, plain, "the request has a name or a number that no database takes\n"};
}

bool is_long(std::string_view path) {
  return live::valve_asked(path, "indicators") || live::valve_asked(path, "history");
}

std::string asked(std::string_view target, std::string_view key) {
  return live::query_value(target, key).value_or("");
}

}  // namespace

FleetPage::FleetPage(const FleetSettings& settings) : connection_(settings.connection) {
  (void)read_settings(session());
}

Session& FleetPage::session() {
  if (!session_) session_.emplace(connection_, "spoolflow fleet page", answers_within);
  return *session_;
}

live::PageContent FleetPage::content() {
  return {.name = "spoolflow fleet",
          .answer = [this](std::string_view method, std::string_view target) { return answer(method, target); },
          .is_file = is_page_file,
          .act = [this](const live::AlarmOrder& order, const std::string& by) { return act_on_alarm(order, by); },
          .stream = {},
          .is_long = is_long,
          .long_answer = [this](std::string_view method, std::string_view target,
                                const std::stop_token&) { return long_answer(method, target); }};
}

PageAnswer FleetPage::answer(std::string_view method, std::string_view target) {
  if (method != "GET" && method != "HEAD") return {405, plain, "only GET is answered\n"};
  try {
    return found(target.substr(0, target.find('?')), target);
  } catch (const ContentRefused&) {
    return no_such_text();
  } catch (const ServerAway& error) {
    session_.reset();  // the next one asks again
    return {503, plain, std::string(error.what()) + "\n"};
  }
}

PageAnswer FleetPage::found(std::string_view path, std::string_view target) {
  if (path == "/") return {200, "text/html; charset=utf-8", page_file("fleet.html")};
  if (path == "/fleet.js") return {200, "text/javascript; charset=utf-8", page_file("fleet.js")};
  if (path == "/fleet.css") return {200, "text/css; charset=utf-8", page_file("fleet.css")};
  if (path == "/api/v1/valves") {
    return {200, json,
            valves_json(valves(), {asked(target, "site"), asked(target, "series"), asked(target, "search")})};
  }
  if (path == "/api/v1/sites") return {200, json, sites_json(shown_sites(valves()))};
  if (path == "/api/v1/alarms")
    return {200, json, alarms_json(fleet_alarms(session(), asked(target, "valve"), shown_cleared))};
  if (path == "/api/v1/events")
    return {200, json, events_json(fleet_events(session(), asked(target, "valve"), shown_events))};
  if (path == "/api/v1/series") return {200, json, series_json(spread())};
  if (path == "/api/v1/distribution") {
    const auto one = spread().find({asked(target, "series"), asked(target, "indicator")});
    if (one == spread_.end()) return {404, plain, "no valve has this indicator in a series of this name\n"};
    return {200, json, distribution_json(one->second)};
  }
  if (path == "/api/v1/partitions") return {200, json, partitions_json(partition_status(session()))};
  if (path == "/api/v1/openapi.json") return {200, json, page_file("fleet_openapi.json")};
  if (path == "/metrics") {
    return {200, "text/plain; version=0.0.4; charset=utf-8",
            metrics_text(shown_sites(valves()), partition_status(session()))};
  }
  return {404, plain, "there is nothing here; see /, /api/v1/valves, /api/v1/sites, /api/v1/series and /metrics\n"};
}

PageAnswer FleetPage::long_answer(std::string_view method, std::string_view target) {
  if (method != "GET" && method != "HEAD") return {405, plain, "only GET is answered\n"};
  try {
    if (!long_session_) {
      long_session_.emplace(connection_, "spoolflow fleet page, days", answers_within);
      long_session_->run_script("SET statement_timeout = '15s'");  // ends there, too
    }
    return days_of(target);
  } catch (const ContentRefused&) {
    return no_such_text();
  } catch (const ServerAway& error) {
    long_session_.reset();
    return {503, plain, std::string(error.what()) + "\n"};
  }
}

/// /api/v1/valves/ID/indicators and /api/v1/valves/ID/history; the '/' of an ID may be written as %2F.
PageAnswer FleetPage::days_of(std::string_view target) {
  const std::string_view path = target.substr(0, target.find('?'));
  const auto indicators = live::valve_asked(path, "indicators");
  const std::string name = live::unescaped(indicators ? *indicators : live::valve_asked(path, "history").value_or(""));
  const auto number = valve_number(*long_session_, name);
  if (!number) return {404, plain, "there is no valve of this name\n"};
  const auto span = live::span_asked(target);
  if (!span) return live::no_span();
  if (!indicators) return {200, json, live::flow_days_json(name, *span, flow_days(*long_session_, *number, *span))};
  std::vector<live::IndicatorDays> days;
  for (KeptDays& one : indicator_days(*long_session_, *number, *span))
    days.push_back({std::move(one.name), std::move(one.unit), std::move(one.points)});
  return {200, json, live::indicator_days_json(name, *span, days)};
}

PageAnswer FleetPage::done(const live::AlarmOrder& order, const AlarmAct& act) {
  std::optional<live::Alarm> seen;
  if (order.action == "acknowledge") {
    seen = acknowledge(session(), act);
  } else if (order.action == "shelve") {
    const auto hours = live::hours_asked(order.body);
    if (!hours) return live::no_hours();
    seen = shelve(session(), act, act.wall_ms + static_cast<std::int64_t>(3.6e6 * *hours));
    if (seen && seen->shelved_until_ms == 0 && live::state_of(*seen) == "cleared") return live::is_cleared();
  } else if (order.action == "unshelve") {
    seen = unshelve(session(), act);
  } else {
    const auto text = live::comment_asked(order.body);
    if (!text) return live::no_comment();
    seen = comment(session(), act, *text);
  }
  read_.reset();  // the page shows it
  return seen ? PageAnswer{200, json, alarm_json(*seen)} : PageAnswer{404, plain, "there is no alarm of this name\n"};
}

std::optional<PageAnswer> FleetPage::act_on_alarm(const live::AlarmOrder& order, const std::string& by) {
  const std::string name = live::unescaped(order.alarm);
  const std::size_t slash = name.rfind('/');
  if (slash == std::string::npos || name.find('/') == slash) return std::nullopt;
  std::int64_t id = 0;
  const char* const last = name.data() + name.size();
  const auto [end, error] = std::from_chars(name.data() + slash + 1, last, id);
  if (error != std::errc() || end != last) return std::nullopt;
  try {
    return done(order, {name.substr(0, slash), id, by, live::wall_ms()});
  } catch (const ContentRefused&) {
    return no_such_text();
  } catch (const ServerAway& why) {
    session_.reset();
    return PageAnswer{503, plain, std::string(why.what()) + "\n"};
  }
}

/// Of each model that was not met before.
void FleetPage::learn_series(const std::vector<ValveNow>& valves) {
  for (const ValveNow& valve : valves) {
    if (series_.contains(valve.model_sha256)) continue;
    std::string& name = series_[valve.model_sha256];
    name = "model " + valve.model_sha256.substr(0, 8);
    const auto packed = packed_model(session(), valve.model_sha256);
    try {
      Models read;
      const auto model = packed ? read.add(valve.model_sha256, *packed) : std::nullopt;
      if (model && !model->model->valve.name.empty()) name = model->model->valve.name;
    } catch (const model::ModelError&) {  // of another version of the program
    }
  }
}

const std::vector<ShownValve>& FleetPage::valves() {
  const Clock::time_point now = Clock::now();
  if (read_ && now - *read_ < valves_hold) return valves_;
  std::vector<ValveNow> kept = valves_now(session());
  learn_series(kept);
  valves_ = shown_valves(std::move(kept), fleet_alarms(session(), "", 0), series_);
  read_ = Clock::now();
  return valves_;
}

const Distributions& FleetPage::spread() {
  const Clock::time_point now = Clock::now();
  if (spread_read_ && now - *spread_read_ < spread_holds) return spread_;
  spread_ = distributions(valves(), indicators_now(session()));
  spread_read_ = Clock::now();
  return spread_;
}

}  // namespace spoolflow::fleet
