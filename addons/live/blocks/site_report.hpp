#pragma once
/// What a site that estimates by itself sends of a valve and a second, instead of samples: its summary, indicators,
/// events and alarms as its own store keeps them. The body of a block of version 2 (block.hpp).
#include <cstdint>
#include <span>
#include <vector>

#include "addons/live/history/store.hpp"

namespace spoolflow::fleet {

struct SiteReport {
  live::Summary summary{};    ///< has no samples where none came
  std::uint64_t samples = 0;  ///< since the site's store began
  double energy_J = 0;        ///< likewise
  std::vector<live::KeptIndicator> indicators{};
  std::vector<live::Event> events{};  ///< without ids and the valve, whose block it is
  std::vector<live::Alarm>
      alarms{};  ///< raised or changed; with the site's ids, below 2^40, without the valve and recordings
};

/// Whether a database and a calendar have that time, 1970 to 9999.
inline constexpr bool is_wall_ms(std::int64_t ms) {
  return ms >= 0 && ms < 253'402'300'800'000;
}
/// Counts stay below it: SQL's numbers are signed.
inline constexpr std::uint64_t largest_count = std::uint64_t{1} << 62U;
inline constexpr double largest_number = 1e15;  ///< of a report, to both sides; beyond it nothing is known
/// Bytes of a name, a unit, a cause; of the text of an event or an alarm.
inline constexpr std::size_t longest_word = 256, longest_text = 4096;

/// What the reader would refuse is written as it can be kept: a number beyond the largest one as not known, a byte that
/// is no text as '?', a text that is too long cut.
[[nodiscard]] std::vector<std::uint8_t> write_report(const SiteReport& report);
/// False where the bytes are no such body; `report` is then worthless.
[[nodiscard]] bool read_report(std::span<const std::uint8_t> bytes, SiteReport& report);

}  // namespace spoolflow::fleet
