#include "spoolflow/plausibility/channel_findings.hpp"

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "spoolflow/plausibility/block_means.hpp"
#include "spoolflow/plausibility/clipped_channel.hpp"
#include "spoolflow/plausibility/coil_currents.hpp"
#include "spoolflow/plausibility/frozen_channel.hpp"
#include "spoolflow/plausibility/limits.hpp"
#include "spoolflow/plausibility/motion_delay.hpp"
#include "spoolflow/plausibility/relation.hpp"
#include "spoolflow/plausibility/signals/coil_signals.hpp"
#include "spoolflow/plausibility/signals/sample_grid.hpp"

namespace spoolflow::plausibility {

using recording::Channel;
using recording::Recording;

std::vector<Finding> channel_findings(const std::vector<const Recording*>& campaign) {
  constexpr std::size_t most_blocks = 2500;
  std::vector<Recording> all;
  double changes_per_s = 0;
  for (const Recording* recording : campaign) {
    all.push_back(block_means(*recording, most_blocks));
    changes_per_s = std::max(changes_per_s, oil_temperature_changes_per_s(all.back()));
  }
  std::vector<Finding> out;
  const auto add = [&](const Recording& of, bool cannot_be, const std::string& text) {
    if (!text.empty()) out.push_back({cannot_be, fmt::format("{}: {}", file_of(of), text)});
  };
  for (const Recording& means : all) {
    add(means, true, frozen_channel(means));
    add(means, true, signed_coil_currents(means));
    for (const std::string& leap : resistance_leaps(means)) add(means, true, leap);
    for (const std::string& zero : currents_without_voltage(means)) add(means, false, zero);
    if (changes_per_s * range_of(means.column(Channel::time)) >= fewest_oil_changes)
      add(means, false, frozen_oil_temperature(means));
  }
  for (const Recording* recording : campaign) {
    ClippedChannels clipped;
    clipped.take(recording->columns);
    for (const std::string& each : clipped.missing_markers()) add(*recording, true, each);
    for (const std::string& each : clipped.findings()) add(*recording, true, each);
    SampleGrid grid;
    grid.take(recording->columns);
    add(*recording, false, grid.resampled());
    add(*recording, false, grid.coarse_current());
    MotionDelay delay;
    delay.take(recording->columns);
    if (const auto late_s = delay.late_s()) add(*recording, true, shown_delay(*late_s));
  }
  return out;
}

}  // namespace spoolflow::plausibility
