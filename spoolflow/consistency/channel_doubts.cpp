#include "spoolflow/consistency/channel_doubts.hpp"

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "spoolflow/consistency/block_means.hpp"
#include "spoolflow/consistency/coil_currents.hpp"
#include "spoolflow/consistency/frozen_channel.hpp"
#include "spoolflow/consistency/limits.hpp"
#include "spoolflow/consistency/relation.hpp"

namespace spoolflow::consistency {

using recording::Channel;
using recording::Recording;

std::vector<Doubt> channel_doubts(const std::vector<const Recording*>& campaign) {
  constexpr std::size_t most_blocks = 2500;
  std::vector<Recording> all;
  double changes_per_s = 0;
  for (const Recording* recording : campaign) {
    all.push_back(block_means(*recording, most_blocks));
    changes_per_s = std::max(changes_per_s, oil_temperature_changes_per_s(all.back()));
  }
  std::vector<Doubt> out;
  const auto add = [&](const Recording& of, bool cannot_be, const std::string& text) {
    if (!text.empty()) out.push_back({cannot_be, fmt::format("{}: {}", file_of(of), text)});
  };
  for (const Recording& means : all) {
    add(means, true, frozen_channel(means));
    add(means, true, signed_coil_currents(means));
    if (changes_per_s * range_of(means.column(Channel::time)) >= fewest_oil_changes)
      add(means, false, frozen_oil_temperature(means));
  }
  return out;
}

}  // namespace spoolflow::consistency
