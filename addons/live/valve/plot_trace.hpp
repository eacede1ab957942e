#pragma once
/// The last half minute of a valve's answers, thinned so that a page can follow them at any sampling rate: smallest and
/// largest flow, the band's ends and the status of each fiftieth of a second.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "spoolflow/sensor/basis/sample.hpp"

namespace spoolflow::live {

inline constexpr double plot_point_s = 0.02;
inline constexpr std::size_t plot_points = 1500;

struct PlotPoint {
  double time_s = 0;  ///< of its last sample, by the source's clock
  float flow_min_m3_per_s = 0, flow_max_m3_per_s = 0;
  float lower_min_m3_per_s = 0, upper_max_m3_per_s = 0;
  float position_m = 0, current_A = 0;  ///< of its last sample; NaN: not measured
  std::uint32_t status = 0;             ///< bits that were set at least once
};

class PlotTrace {
 public:
  void add(double time_s, double position_m, double current_A, const sensor::Estimate<double>& answer) {
    const double slot = std::floor(time_s / plot_point_s);
    if (begun_ == 0 || slot != slot_) open(slot);
    PlotPoint& point = points_[(begun_ - 1) % plot_points];
    const auto flow = static_cast<float>(answer.flow_m3_per_s);
    point.time_s = time_s;
    point.flow_min_m3_per_s = std::min(point.flow_min_m3_per_s, flow);
    point.flow_max_m3_per_s = std::max(point.flow_max_m3_per_s, flow);
    point.lower_min_m3_per_s = std::min(point.lower_min_m3_per_s, static_cast<float>(answer.flow_lower_m3_per_s));
    point.upper_max_m3_per_s = std::max(point.upper_max_m3_per_s, static_cast<float>(answer.flow_upper_m3_per_s));
    point.position_m = static_cast<float>(position_m);
    point.current_A = static_cast<float>(current_A);
    point.status |= static_cast<std::uint32_t>(answer.status);
  }
  /// Number of points so far, the one that still grows included.
  [[nodiscard]] std::uint64_t size() const { return begun_; }
  /// Appends the points from that number on, as far as they are still there; returns the number of the first.
  std::uint64_t copy_from(std::uint64_t first, std::vector<PlotPoint>& out) const {
    const std::uint64_t oldest = begun_ > points_.size() ? begun_ - points_.size() : 0;
    first = first < oldest ? oldest : first;
    for (std::uint64_t k = first; k < begun_; ++k) out.push_back(points_[k % points_.size()]);
    return first;
  }

 private:
  void open(double slot) {
    if (points_.empty()) points_.resize(plot_points);
    slot_ = slot;
    constexpr float far = std::numeric_limits<float>::infinity();
    points_[begun_++ % plot_points] = {0, far, -far, far, -far, 0, 0, 0};
  }
  double slot_ = 0;
  std::uint64_t begun_ = 0;
  std::vector<PlotPoint> points_;
};

}  // namespace spoolflow::live
