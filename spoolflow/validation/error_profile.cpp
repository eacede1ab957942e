#include "spoolflow/validation/error_profile.hpp"

#include <algorithm>
#include <cmath>

namespace spoolflow::validation {

ErrorProfile::ErrorProfile(double bin_width, double full_scale_m3_per_s, double origin)
    : bin_width_(bin_width), full_scale_m3_per_s_(full_scale_m3_per_s), origin_(origin) {}

void ErrorProfile::add(double quantity, double error_m3_per_s, bool inside_band) {
  if (std::isnan(quantity) || std::isnan(error_m3_per_s)) return;
  Magnitudes& magnitudes = bins_[static_cast<int>(std::floor((quantity - origin_) / bin_width_))];
  const double at = std::abs(error_m3_per_s) / full_scale_m3_per_s_ * cells;
  ++magnitudes.count[static_cast<std::size_t>(std::min(at, static_cast<double>(cells - 1)))];
  ++magnitudes.samples;
  magnitudes.inside += inside_band ? 1 : 0;
  ++samples_;
}

void ErrorProfile::append(const ErrorProfile& others) {
  for (const auto& [index, magnitudes] : others.bins_) {
    Magnitudes& mine = bins_[index];
    for (std::size_t c = 0; c < cells; ++c) mine.count[c] += magnitudes.count[c];
    mine.samples += magnitudes.samples;
    mine.inside += magnitudes.inside;
  }
  samples_ += others.samples_;
}

double ErrorProfile::percentile(const Magnitudes& magnitudes, double share) const {
  const double wanted = share * static_cast<double>(magnitudes.samples);
  double below = 0;
  for (std::size_t c = 0; c < cells; ++c) {
    below += magnitudes.count[c];
    if (below > wanted) return (static_cast<double>(c) + 0.5) / cells * full_scale_m3_per_s_;
  }
  return full_scale_m3_per_s_;
}

std::vector<ProfileBin> ErrorProfile::bins() const {
  constexpr std::size_t fewest_in_bin = 20;
  std::vector<ProfileBin> out;
  for (const auto& [index, magnitudes] : bins_) {
    if (magnitudes.samples < std::max(fewest_in_bin, samples_ / 1000)) continue;
    const double from = origin_ + index * bin_width_;
    out.push_back({from, from + bin_width_, magnitudes.samples, percentile(magnitudes, 0.5),
                   percentile(magnitudes, 0.95),
                   static_cast<double>(magnitudes.inside) / static_cast<double>(magnitudes.samples)});
  }
  return out;
}

std::vector<DistributionPoint> ErrorProfile::distribution() const {
  constexpr double smallest_step = 0.005;
  std::vector<DistributionPoint> out{{0, 0}};
  if (samples_ == 0) return out;
  std::size_t below = 0;
  for (std::size_t c = 0; c < cells; ++c) {
    for (const auto& [index, magnitudes] : bins_) below += magnitudes.count[c];
    const double share = static_cast<double>(below) / static_cast<double>(samples_);
    const bool last = below == samples_;
    if (share - out.back().share < smallest_step && !last) continue;
    out.push_back({static_cast<double>(c + 1) / cells * full_scale_m3_per_s_, share});
    if (last) break;
  }
  return out;
}

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
