#include "spoolflow/validation/direction_profile.hpp"

#include <cmath>

namespace spoolflow::validation {
namespace {

constexpr std::size_t fewest = 20;

}  // namespace

DirectionProfile::DirectionProfile(const Sizes& sizes)
    : stroke_m_(sizes.stroke_m),
      lowest_m_(sizes.whole_valve ? -sizes.stroke_m : 0.0),
      magnitudes_(1, sizes.full_scale_m3_per_s) {}

void DirectionProfile::add(Direction direction, double position_m, double error_m3_per_s) {
  if (std::isnan(position_m) || std::isnan(error_m3_per_s)) return;
  magnitudes_.add(static_cast<double>(direction) + 0.5, error_m3_per_s);
  const double share = (position_m - lowest_m_) / stroke_m_;
  if (direction == Direction::rest || share < 0 || position_m >= stroke_m_) return;
  Sum& sum = sums_[static_cast<std::size_t>(direction)][static_cast<std::size_t>(share * positions)];
  sum.error_m3_per_s += error_m3_per_s;
  ++sum.samples;
}

void DirectionProfile::append(const DirectionProfile& others) {
  magnitudes_.append(others.magnitudes_);
  for (std::size_t d = 0; d < sums_.size(); ++d) {
    for (std::size_t p = 0; p < 2 * positions; ++p) {
      sums_[d][p].error_m3_per_s += others.sums_[d][p].error_m3_per_s;
      sums_[d][p].samples += others.sums_[d][p].samples;
    }
  }
}

std::optional<ProfileBin> DirectionProfile::magnitudes(Direction direction) const {
  for (const ProfileBin& bin : magnitudes_.bins()) {
    if (std::lround(bin.from) == static_cast<long>(direction)) return bin;
  }
  return std::nullopt;
}

std::vector<DirectionBin> DirectionProfile::bins() const {
  std::vector<DirectionBin> out;
  for (std::size_t p = 0; p < 2 * positions; ++p) {
    const Sum& opening = sums_[0][p];
    const Sum& closing = sums_[1][p];
    if (opening.samples < fewest || closing.samples < fewest) continue;
    const double step_m = stroke_m_ / positions;
    out.push_back({lowest_m_ + static_cast<double>(p) * step_m, lowest_m_ + static_cast<double>(p + 1) * step_m,
                   opening.error_m3_per_s / static_cast<double>(opening.samples),
                   closing.error_m3_per_s / static_cast<double>(closing.samples)});
  }
  return out;
}

std::optional<Hysteresis> DirectionProfile::hysteresis() const {
  std::optional<Hysteresis> out;
  for (const DirectionBin& bin : bins()) {
    const double difference = bin.opening_m3_per_s - bin.closing_m3_per_s;
    if (out && std::abs(difference) <= std::abs(out->difference_m3_per_s)) continue;
    out = Hysteresis{difference, 0.5 * (bin.from_m + bin.to_m)};
  }
  return out;
}

}  // namespace spoolflow::validation
