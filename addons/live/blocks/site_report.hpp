#pragma once
/// What a site that estimates by itself tells of a valve and of a second, instead of samples: its summary, indicators,
/// events and alarms as its own store keeps them. The body of a block of version 2 (docs/formats/block.md).
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

[[nodiscard]] std::vector<std::uint8_t> write_report(const SiteReport& report);
/// False where the bytes are no such body; `report` is then worthless.
[[nodiscard]] bool read_report(std::span<const std::uint8_t> bytes, SiteReport& report);

}  // namespace spoolflow::fleet
