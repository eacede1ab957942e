#pragma once
/// How the oil that references say has passed compares with the sensor's.
#include <cstddef>
#include <vector>

#include "spoolflow/calibration/references/passed_oil.hpp"
#include "spoolflow/sensor/machine_reference.hpp"

namespace spoolflow::calibration {

/// One interval.
struct OilRatio {
  std::size_t reference;
  double log_ratio;       ///< logarithm of the reference's volume over the sensor's
  double deviation;       ///< standard deviation expected of it beside what all intervals have in common
  double seconds_per_m3;  ///< of the interval over the reference's volume: what a leakage takes of each
  bool used;
  double seen_share;  ///< the sensor's volume over the reference's
};

/// Less of a reference's oil is of the other direction; where the reference has so little of the sensor's, it is of
/// another unit or another valve.
inline constexpr double least_seen_share = sensor::ReferencePriors::least_seen_share;

[[nodiscard]] std::vector<OilRatio> oil_ratios(const std::vector<PassedOil>& oil, const std::vector<double>& sensor_m3,
                                               double rated_flow_m3_per_s);

/// Loss of a residual in standard deviations, negative logarithm of Student's t of four degrees of freedom: sensors err
/// by much at times.
[[nodiscard]] double interval_loss(double deviations);

/// What all used intervals of a reference have in common.
struct OilLevel {
  double log_ratio, deviation;
  double loss;  ///< of its intervals about it, which may all scatter more than expected, by what is likeliest
  std::size_t count;
};
[[nodiscard]] OilLevel level_of(const std::vector<OilRatio>& ratios, std::size_t reference);

/// The same with oil that is lost beside the valve at a constant rate.
struct OilLeak {
  double leak_m3_per_s;  ///< > 0: the reference misses oil
  double deviation_m3_per_s;
  double gain;  ///< by how much less the loss is with it
};
[[nodiscard]] OilLeak leak_of(const std::vector<OilRatio>& ratios, std::size_t reference);

/// Takes the intervals out of use that lie apart from their reference's others, more than 8 % and than four times their
/// median distance from the median.
void leave_out_apart(std::vector<OilRatio>& ratios);

}  // namespace spoolflow::calibration
