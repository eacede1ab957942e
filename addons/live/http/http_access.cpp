#include "addons/live/http/http_access.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "addons/live/http/login_text.hpp"

namespace spoolflow::live {
namespace {

constexpr std::string_view login_path = "/api/v1/login", logout_path = "/api/v1/logout",
                           session_path = "/api/v1/session";

std::string_view without_port(std::string_view host) {
  const std::size_t colon = host.rfind(':');
  const bool has_port = colon != std::string_view::npos && host.find(']', colon) == std::string_view::npos;
  return has_port ? host.substr(0, colon) : host;
}

/// Its name assures browsers that only this server, by TLS, can have set it.
std::string cookie_name(bool encrypted) {
  return encrypted ? "__Host-spoolflow" : "spoolflow";
}

/// The value of that cookie.
std::string_view cookie_value(std::string_view cookies, std::string_view name) {
  while (!cookies.empty()) {
    const std::size_t end = std::min(cookies.find(';'), cookies.size());
    std::string_view one = cookies.substr(0, end);
    cookies.remove_prefix(std::min(end + 1, cookies.size()));
    while (one.starts_with(' ')) one.remove_prefix(1);
    if (one.size() > name.size() && one.starts_with(name) && one[name.size()] == '=') {
      return one.substr(name.size() + 1);
    }
  }
  return {};
}

/// Of the browser itself, which it keeps beyond its session.
constexpr const char* known_suffix = "-known";
constexpr long known_s = 90L * 24 * 3600;

std::string set_cookie(bool encrypted, const std::string& name, std::string_view value, long seconds) {
  return fmt::format("{}={}; Path=/; Max-Age={}; HttpOnly; SameSite=Strict{}", name, value, seconds,
                     encrypted ? "; Secure" : "");
}

std::string_view bearer_of(const PageRequest& request) {
  constexpr std::string_view scheme = "Bearer ";
  const std::string_view text = request.authorization;
  return text.starts_with(scheme) ? text.substr(scheme.size()) : std::string_view();
}

std::string_view path_of(const PageRequest& request) {
  const std::string_view target = request.target;
  return target.substr(0, target.find('?'));
}

std::optional<AlarmOrder> alarm_order(std::string_view path, std::string_view body) {
  constexpr std::string_view before = "/api/v1/alarms/";
  for (const std::string_view behind : {"/acknowledge", "/shelve", "/unshelve", "/comment"}) {
    if (!path.starts_with(before) || !path.ends_with(behind)) continue;
    if (path.size() <= before.size() + behind.size()) continue;
    return AlarmOrder{path.substr(before.size(), path.size() - before.size() - behind.size()), behind.substr(1), body};
  }
  return std::nullopt;
}

PageAnswer text_answer(unsigned status, std::string text) {
  return {status, media::plain, std::move(text) + "\n"};
}

PageAnswer too_many() {
  PageAnswer out = text_answer(429, "too many wrong passwords or tokens; wait a minute");
  out.headers.emplace_back("Retry-After", "60");
  return out;
}

PageAnswer only_get() {
  PageAnswer out = text_answer(405, "only GET is answered here");
  out.headers.emplace_back("Allow", "GET, HEAD");
  return out;
}

}  // namespace

bool is_own_host(std::string_view host) {
  const std::string_view name = without_port(host);
  return name == "localhost" || name == "[::1]" ||
         (name.starts_with("127.") && name.size() <= 15 &&
          std::all_of(name.begin(), name.end(), [](char c) { return c == '.' || (c >= '0' && c <= '9'); }));
}

/// Accounts keep strangers out by themselves; without them the name must be one that only this machine has.
bool HttpAccess::knows_host(std::string_view host) const {
  if (access_.has_accounts()) return !host.empty();
  const std::string_view name = without_port(host);
  return is_own_host(host) || std::find(settings_.names.begin(), settings_.names.end(), name) != settings_.names.end();
}

/// Whether a page of this server sent it, by what the browser says.
bool HttpAccess::is_own_page(const PageRequest& request) const {
  const std::string_view origin = request.origin;
  if (origin == fmt::format("{}://{}", request.encrypted ? "https" : "http", request.host)) return true;
  // A proxy with TLS in front, which calls by the name that people use.
  return std::any_of(settings_.names.begin(), settings_.names.end(),
                     [&](const std::string& name) { return origin == "https://" + name; });
}

PageAnswer HttpAccess::login(const PageRequest& request, Access::Time now) {
  if (!is_own_page(request)) return text_answer(403, "log in on the page of this server");
  const auto asked = login_of(request.body);
  if (!asked) return text_answer(400, "a login is {\"name\": \"…\", \"password\": \"…\"}");
  const std::string_view known = cookie_value(request.cookie, cookie_name(request.encrypted) + known_suffix);
  const Access::Login login = access_.login(asked->name, asked->password, {request.peer, known}, now);
  if (login.too_many) return too_many();
  if (login.session.empty()) return text_answer(401, "name or password is wrong");
  PageAnswer out{200, media::json, session_json(login.visitor, access_.has_accounts())};
  const std::string name = cookie_name(request.encrypted);
  out.headers.emplace_back("Set-Cookie", set_cookie(request.encrypted, name + known_suffix, login.browser, known_s));
  out.headers.emplace_back("Set-Cookie", set_cookie(request.encrypted, name, login.session,
                                                    static_cast<long>(3600 * settings_.session_hours)));
  return out;
}

PageAnswer HttpAccess::logout(const PageRequest& request) {
  if (!is_own_page(request)) return text_answer(403, "log out on the page of this server");
  access_.logout(cookie_value(request.cookie, cookie_name(request.encrypted)));
  PageAnswer out{200, media::json, session_json({}, access_.has_accounts())};
  out.headers.emplace_back("Set-Cookie", set_cookie(request.encrypted, cookie_name(request.encrypted), "", 0));
  return out;
}

PageAnswer HttpAccess::act(const PageRequest& request, const Visitor& visitor, const AlarmOrder& order) {
  // A browser names the page that posts. Where a cookie speaks for the sender it must be there; else it may be missing.
  if (!is_own_page(request) && (visitor.by_cookie || !request.origin.empty())) {
    return text_answer(403, "acknowledge, shelve and comment on the page of this server, or with a token");
  }
  if (visitor.role < Role::acknowledge) return text_answer(403, "this needs the role \"acknowledge\"");
  if (auto answer = content_.act(order, visitor.name)) return std::move(*answer);
  return only_get();
}

PageAnswer HttpAccess::posted(const PageRequest& request, const Visitor& visitor) {
  const auto order = alarm_order(path_of(request), request.body);
  return order ? act(request, visitor, *order) : only_get();
}

Admission HttpAccess::admit(const PageRequest& request, Access::Time now) {
  if (!knows_host(request.host)) {
    return {
        text_answer(421, "this server is 127.0.0.1 or localhost; give names of a proxy by names = [\"…\"] in [page]")};
  }
  const std::string_view path = path_of(request);
  const bool posts = request.method == "POST";
  if (posts && path == login_path && access_.has_accounts()) return {login(request, now)};
  if (posts && path == logout_path) return {logout(request)};
  if (!posts && !request.upgrade && content_.is_file(path)) {
    return {content_.answer(request.method, request.target)};
  }
  const auto [visitor, often] =
      access_.who(cookie_value(request.cookie, cookie_name(request.encrypted)), bearer_of(request), request.peer, now);
  if (often) return {too_many()};
  if (request.method == "GET" && path == session_path) {
    return {{200, media::json, session_json(visitor, access_.has_accounts())}};
  }
  if (visitor.role == Role::none) {
    PageAnswer out = text_answer(401, "log in on the page, or send a token: Authorization: Bearer NAME.TOKEN");
    out.headers.emplace_back("WWW-Authenticate", "Bearer realm=\"" + content_.name + "\"");
    return {out};
  }
  if (request.upgrade) {
    const bool own = is_own_page(request) || (request.origin.empty() && !visitor.by_cookie);
    NextFrame stream = content_.stream && own ? content_.stream(path) : NextFrame();
    if (!stream) return {text_answer(403, "no stream is there for this page")};
    return {{}, std::move(stream)};
  }
  if (posts) return {posted(request, visitor)};
  if (content_.is_long && content_.is_long(path)) return {.answer = {}, .is_long = true};
  return {content_.answer(request.method, request.target)};
}

}  // namespace spoolflow::live
