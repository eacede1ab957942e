#include "addons/live/page/alarm_orders.hpp"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include "addons/live/page/alarm_text.hpp"

namespace spoolflow::live {
namespace {

using media::plain;

constexpr double longest_shelf_h = 168;
constexpr std::size_t longest_comment = 500;

/// A member of a JSON object; null where the body is none or has none of that name.
Json member(std::string_view body, const char* name) {
  const Json asked = Json::parse(body, nullptr, false);
  return asked.is_object() ? asked.value(name, Json()) : Json();
}

}  // namespace

std::optional<double> hours_asked(std::string_view body) {
  const Json asked = member(body, "hours");
  if (!asked.is_number()) return std::nullopt;
  const auto hours = asked.get<double>();
  return hours > 0 && hours <= longest_shelf_h ? std::optional(hours) : std::nullopt;
}

std::optional<std::string> comment_asked(std::string_view body) {
  const Json asked = member(body, "text");
  if (!asked.is_string()) return std::nullopt;
  auto text = asked.get<std::string>();
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; }, ' ');
  const std::size_t first = text.find_first_not_of(' ');
  if (first == std::string::npos) return std::nullopt;
  text = text.substr(first, text.find_last_not_of(' ') + 1 - first);
  return text.size() <= longest_comment ? std::optional(text) : std::nullopt;
}

PageAnswer no_hours() {
  return {400, plain, fmt::format("shelve for a time of at most {} hours: {{\"hours\": 8}}\n", longest_shelf_h)};
}

PageAnswer no_comment() {
  return {400, plain, fmt::format("a comment is {{\"text\": \"…\"}} of 1 to {} bytes\n", longest_comment)};
}

PageAnswer is_cleared() {
  return {409, plain, "the alarm is gone and acknowledged\n"};
}

namespace {

PageAnswer shown(const std::optional<Alarm>& alarm) {
  if (!alarm) return {404, plain, "there is no alarm of this number\n"};
  return {200, media::json, written(json_of(*alarm))};
}

PageAnswer shelved(Engine& engine, std::int64_t id, const AlarmOrder& order, const std::string& by) {
  const auto hours = hours_asked(order.body);
  if (!hours) return no_hours();
  const auto alarm = engine.shelve(id, by, *hours);
  if (alarm && alarm->shelved_until_ms == 0) return is_cleared();
  return shown(alarm);
}

}  // namespace

std::optional<PageAnswer> act_on_alarm(Engine& engine, const AlarmOrder& order, const std::string& by) {
  const std::string_view alarm = order.alarm;
  std::int64_t id = 0;
  const auto [end, error] = std::from_chars(alarm.data(), alarm.data() + alarm.size(), id);
  if (error != std::errc() || end != alarm.data() + alarm.size()) return std::nullopt;
  if (order.action == "acknowledge") return shown(engine.acknowledge(id, by));
  if (order.action == "shelve") return shelved(engine, id, order, by);
  if (order.action == "unshelve") return shown(engine.unshelve(id, by));
  const auto text = comment_asked(order.body);
  if (!text) return no_comment();
  return shown(engine.comment(id, by, *text));
}

}  // namespace spoolflow::live
