#include "addons/live/valve/utc_text.hpp"

#include <cmath>
#include <ctime>

#include <fmt/chrono.h>

namespace spoolflow::live {

std::string utc(std::int64_t wall_ms) {
  const auto second = static_cast<std::time_t>(std::floor(static_cast<double>(wall_ms) / 1000));
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z", fmt::gmtime(second), wall_ms - std::int64_t{1000} * second);
}

}  // namespace spoolflow::live
