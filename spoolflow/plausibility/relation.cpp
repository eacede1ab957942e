#include "spoolflow/plausibility/relation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "spoolflow/plausibility/limits.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::plausibility {
namespace {

/// Null where it is not among them.
const Deviation* same_relation(const std::vector<Deviation>& deviations, const Deviation& as) {
  const auto same = std::ranges::find_if(
      deviations, [&](const Deviation& deviation) { return deviation.of == as.of && deviation.file == as.file; });
  return same == deviations.end() ? nullptr : &*same;
}

}  // namespace

using recording::Channel;
using recording::Recording;

double factor_over(double value, double usual, double factor) {
  return value > 0 ? std::abs(std::log(value / usual)) / std::log(factor) : 20.0;
}

std::string shown_value(Channel channel, double value) {
  switch (recording::dimension(channel)) {
    case units::Dimension::length:
      return fmt::format("{:.4g} mm", units::mm_from_m(value));
    case units::Dimension::pressure:
      return fmt::format("{:.4g} bar", units::bar_from_Pa(value));
    case units::Dimension::volume_flow:
      return fmt::format("{:.4g} L/min", units::L_per_min_from_m3_per_s(value));
    case units::Dimension::current:
      return fmt::format("{:.4g} A", value);
    case units::Dimension::voltage:
      return fmt::format("{:.4g} V", value);
    default:
      return fmt::format("{:.4g} N", value);
  }
}

std::string file_of(const Recording& recording) {
  return recording.file.filename().string();
}

void add_travel(std::vector<Deviation>& to, const Recording& means, double stroke_m, bool strokes,
                double most_outside) {
  constexpr double beyond = 0.15;
  const std::vector<double>& position_m = means.column(Channel::position);
  double outside = 0, count = 0, lowest = 1e300, highest = -1e300;
  for (const double position : position_m) {
    if (!std::isfinite(position)) continue;
    ++count;
    outside += position < -beyond * stroke_m || position > (1 + beyond) * stroke_m;
    lowest = std::min(lowest, position);
    highest = std::max(highest, position);
  }
  if (count == 0) return;
  const bool too_short = strokes && highest - lowest < 0.5 * stroke_m;
  to.push_back({.of = "travel",
                .shown = fmt::format("{:.3g} to {:.3g} mm", units::mm_from_m(lowest), units::mm_from_m(highest)),
                .over_limit = too_short ? impossible : outside / count / most_outside,
                .file = file_of(means)});
}

double over_limit_of(const std::vector<Deviation>& deviations, const Deviation& as) {
  const Deviation* const same = same_relation(deviations, as);
  return same == nullptr ? 0 : same->over_limit;
}

namespace {

/// Lowest and highest of the finite ones; the lowest above the highest where there are none.
std::pair<double, double> ends_of(const std::vector<double>& values) {
  double lowest = 1e300, highest = -1e300;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    lowest = std::min(lowest, value);
    highest = std::max(highest, value);
  }
  return {lowest, highest};
}

}  // namespace

double range_of(const std::vector<double>& values) {
  const auto [lowest, highest] = ends_of(values);
  return std::max(highest - lowest, 0.0);
}

std::optional<double> standing_value(const std::vector<double>& values) {
  constexpr double still = 1e-9;
  const auto [lowest, highest] = ends_of(values);
  const bool stands = lowest <= highest && highest - lowest <= still * std::max(std::abs(lowest), std::abs(highest));
  return stands ? std::optional(lowest) : std::nullopt;
}

Change deciding_change(const std::vector<Deviation>& before, const std::vector<Deviation>& after) {
  Change out{&before.front(), &after.front()};
  double most = -1;
  for (const Deviation& old : before) {
    const Deviation* const same = same_relation(after, old);
    if (same == nullptr) continue;
    const double gain = std::min(old.over_limit, 1e3) - std::min(same->over_limit, 1e3);
    if (gain > most) {
      most = gain;
      out = {&old, same};
    }
  }
  return out;
}

std::string text(const Change& change) {
  return fmt::format("{} goes from {} to {}", change.before->of, change.before->shown, change.after->shown);
}

bool judges_as_much(const std::vector<Deviation>& after, const std::vector<Deviation>& before) {
  return std::ranges::all_of(before, [&](const Deviation& old) {
    const Deviation* const same = same_relation(after, old);
    return same != nullptr && 2 * same->blocks >= old.blocks;
  });
}

double badness(const std::vector<Deviation>& deviations) {
  double out = 0;
  for (const Deviation& deviation : deviations) {
    const double over = std::isfinite(deviation.over_limit) ? std::min(deviation.over_limit, 1e3) : 1e3;
    out += std::log1p(over * over * over * over);
  }
  return out;
}

}  // namespace spoolflow::plausibility
