#pragma once
/// Times of day and dates as loggers write them.
#include <cstdint>
#include <optional>
#include <string_view>

namespace spoolflow::recording {

struct ClockTime {
  std::int64_t day = 0;  ///< since 1970-01-01; 0 where no date is written
  double second = 0;     ///< of the day, in UTC where an offset is written

  [[nodiscard]] double since(const ClockTime& origin) const {
    constexpr double day_s = 86400;
    return static_cast<double>(day - origin.day) * day_s + (second - origin.second);
  }
};

/// ISO 8601 (2026-11-22T10:15:30.250, a space for T, Z or +01:00 behind it), 22.11.2026 10:15:30,250, and 10:15:30.250
/// alone; 3/4/2025 11:59:59.700 AM, month first; seconds and their share may be left out, with comma or point. Nothing
/// where the text is none of these or no such day or time exists.
[[nodiscard]] std::optional<ClockTime> read_clock_time(std::string_view text);

}  // namespace spoolflow::recording
