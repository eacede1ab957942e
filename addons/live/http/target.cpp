#include "addons/live/http/target.hpp"

#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>

namespace spoolflow::live {
namespace {

std::optional<char> escaped(std::string_view digits) {
  unsigned value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
  if (error != std::errc() || end != digits.data() + digits.size() || digits.size() != 2) return std::nullopt;
  return static_cast<char>(value);
}

}  // namespace

std::string unescaped(std::string_view text) {
  std::string out;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const auto read = text[k] == '%' ? escaped(text.substr(k + 1, 2)) : std::nullopt;
    out += read ? *read : text[k];
    if (read) k += 2;
  }
  return out;
}

std::optional<std::string_view> valve_asked(std::string_view path, std::string_view what) {
  constexpr std::string_view before = "/api/v1/valves/";
  if (!path.starts_with(before) || !path.ends_with(what)) return std::nullopt;
  if (path.size() <= before.size() + what.size() + 1 || path[path.size() - what.size() - 1] != '/') return std::nullopt;
  return path.substr(before.size(), path.size() - before.size() - what.size() - 1);
}

std::optional<std::string> query_value(std::string_view target, std::string_view key) {
  std::size_t begin = target.find('?');
  while (begin != std::string_view::npos) {
    std::string_view one = target.substr(begin + 1);
    one = one.substr(0, one.find('&'));
    if (one.size() > key.size() && one.starts_with(key) && one[key.size()] == '=') {
      return unescaped(one.substr(key.size() + 1));
    }
    begin = target.find('&', begin + 1);
  }
  return std::nullopt;
}

std::optional<std::int64_t> instant_ms(const std::string& text) {
  using namespace std::chrono;
  double seconds = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seconds);
  if (error == std::errc() && end == text.data() + text.size()) {
    return std::abs(seconds) < 1e12 ? std::optional(std::llround(1e3 * seconds)) : std::nullopt;
  }
  int y = 0, hour = 0, minute = 0, used = 0;
  unsigned m = 0, d = 0;
  double s = 0;
  const int read = std::sscanf(text.c_str(), "%4d-%2u-%2u%n", &y, &m, &d, &used);
  std::string rest = text.substr(std::min<std::size_t>(text.size(), static_cast<std::size_t>(used)));
  if (rest.ends_with('Z')) rest.pop_back();
  const year_month_day day{year(y), month(m), std::chrono::day(d)};
  if (read != 3 || !day.ok()) return std::nullopt;
  if (!rest.empty()) {
    int taken = 0;
    const int parts = std::sscanf(rest.c_str(), "T%2d:%2d%n:%6lf%n", &hour, &minute, &taken, &s, &taken);
    if (parts < 2 || static_cast<std::size_t>(taken) != rest.size()) return std::nullopt;
    if (hour < 0 || hour > 24 || minute < 0 || minute > 59 || s < 0 || s > 60) return std::nullopt;
  }
  const std::int64_t whole = duration_cast<milliseconds>(sys_days(day).time_since_epoch()).count();
  return whole + 3'600'000 * std::int64_t{hour} + 60'000 * std::int64_t{minute} + std::llround(1e3 * s);
}

}  // namespace spoolflow::live
