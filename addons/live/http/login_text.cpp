#include "addons/live/http/login_text.hpp"

#include "addons/live/http/json_text.hpp"

namespace spoolflow::live {

std::string session_json(const Visitor& visitor, bool has_accounts) {
  return written(Json{{"account", visitor.role == Role::none || !has_accounts ? Json(nullptr) : Json(visitor.name)},
                      {"role", name(visitor.role)},
                      {"accounts", has_accounts}});
}

std::optional<LoginAsked> login_of(const std::string& body) {
  const Json asked = Json::parse(body, nullptr, false);
  if (!asked.is_object() || !asked.contains("name") || !asked.contains("password")) return std::nullopt;
  if (!asked["name"].is_string() || !asked["password"].is_string()) return std::nullopt;
  return LoginAsked{asked["name"].get<std::string>(), asked["password"].get<std::string>()};
}

}  // namespace spoolflow::live
