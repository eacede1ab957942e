#pragma once
/// Numbers and times as the interface writes them. Included by the files that write JSON only: it is a long read.
#include <cmath>
#include <cstdint>
#include <string>

#include <nlohmann/json.hpp>

#include "addons/live/valve/utc_text.hpp"

namespace spoolflow::live {

using Json = nlohmann::ordered_json;  // writes null for what is no number

/// With so many decimals: further digits have no meaning.
inline Json rounded(double value, int decimals) {
  const double power = std::pow(10.0, decimals);
  return std::round(value * power) / power;
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
