#include "spoolflow/plausibility/channel_findings.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "spoolflow/numerics/median.hpp"
#include "spoolflow/plausibility/block_means.hpp"
#include "spoolflow/plausibility/clipped_channel.hpp"
#include "spoolflow/plausibility/coil_currents.hpp"
#include "spoolflow/plausibility/frozen_channel.hpp"
#include "spoolflow/plausibility/limits.hpp"
#include "spoolflow/plausibility/motion_delay.hpp"
#include "spoolflow/plausibility/oil_temperature.hpp"
#include "spoolflow/plausibility/relation.hpp"
#include "spoolflow/plausibility/signals/coil_signals.hpp"
#include "spoolflow/plausibility/signals/force_delay.hpp"
#include "spoolflow/plausibility/signals/sample_grid.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::plausibility {

using recording::Channel;
using recording::Recording;

namespace {

/// All channels but the time, to the last digit.
bool same_samples(const Recording& one, const Recording& other) {
  if (one.size() == 0 || one.size() != other.size()) return false;
  return std::ranges::all_of(recording::all_channels, [&](Channel channel) {
    if (channel == Channel::time) return true;
    return std::ranges::equal(one.column(channel), other.column(channel),
                              [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); });
  });
}

void add_repeated(std::vector<Finding>& to, const std::vector<const Recording*>& campaign) {
  for (std::size_t k = 1; k < campaign.size(); ++k) {
    for (std::size_t before = 0; before < k; ++before) {
      if (!same_samples(*campaign[before], *campaign[k])) continue;
      const std::string name = file_of(*campaign[k]), other = file_of(*campaign[before]);
      to.push_back({true, name == other ? fmt::format("{} is named twice: name the other recording that belongs there, "
                                                      "or take the second one out",
                                                      name)
                                        : fmt::format("{} and {} hold the same samples, one recording under two names: "
                                                      "put the recording that one of them should be in its place",
                                                      other, name)});
      break;
    }
  }
}

}  // namespace

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
    add(means, true, temperature_in_another_unit(means, bench_oil_K, "benches keep their oil at"));
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
    add(*recording, false, late_force(*recording));
    MotionTrace motion;
    motion.take(recording->columns);
    if (const auto late_s = motion_delay_s(motion)) add(*recording, true, shown_delay(*late_s));
  }
  add_repeated(out, campaign);
  return out;
}

std::optional<Finding> stroke_finding(const std::vector<const Recording*>& strokes, double stroke_m) {
  constexpr double highest_share = 0.995, alike = 0.03;
  std::vector<double> ends_m;
  std::string files;
  for (const Recording* recording : strokes) {
    std::vector<double> position_m = recording->column(Channel::position);
    std::erase_if(position_m, [](double value) { return !std::isfinite(value); });
    if (position_m.empty()) continue;
    ends_m.push_back(numerics::quantile(position_m, highest_share));
    files += (files.empty() ? "" : ", ") + file_of(*recording);
  }
  if (ends_m.size() < 2) return std::nullopt;
  const auto [least, most] = std::ranges::minmax(ends_m);
  if (!(most - least < alike * most)) return std::nullopt;
  const double share = most / stroke_m;
  if (share > least_end_of_strokes && share < most_end_of_strokes) return std::nullopt;
  return Finding{true, fmt::format("stroke_mm under [valve] is {:.4g}, and {} all end at {:.3g} mm: correct it, or the "
                                   "unit or scale of their position where the stroke is right",
                                   units::mm_from_m(stroke_m), files, units::mm_from_m(most))};
}

}  // namespace spoolflow::plausibility
