#pragma once
/// Numbers and times as the interface writes them. Included by the files that write JSON only: it is a long read.
#include <chrono>
#include <cmath>
#include <cstdint>
#include <string>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace spoolflow::live {

using Json = nlohmann::ordered_json;  // writes null for what is no number

/// With so many decimals: further digits have no meaning.
inline Json rounded(double value, int decimals) {
  const double power = std::pow(10.0, decimals);
  return std::round(value * power) / power;
}

inline std::string utc(std::int64_t wall_ms) {
  const std::chrono::sys_time<std::chrono::seconds> second{std::chrono::seconds(wall_ms / 1000)};
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z", fmt::gmtime(std::chrono::system_clock::to_time_t(second)),
                     wall_ms % 1000);
}
/// Null where it has not happened.
inline Json utc_or_null(std::int64_t wall_ms) {
  return wall_ms == 0 ? Json(nullptr) : Json(utc(wall_ms));
}

/// Text from outside may be no UTF-8.
inline std::string written(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace spoolflow::live
