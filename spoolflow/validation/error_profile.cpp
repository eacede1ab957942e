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

}  // namespace spoolflow::validation
