#pragma once
/// What the spool was doing at each sample.
#include <span>
#include <vector>

namespace spoolflow::validation {

/// Which samples move (faster than 1 % of the stroke a second), rest (not moving, more than 1 % open to
/// either side), or stand within
/// 2 s of a reversal or a stop of the motion. A sample may belong to none, or to reversal and another.
struct Phases {
  std::vector<bool> moving;
  std::vector<bool> opening;  ///< of the moving samples: away from the centre; the others close
  std::vector<bool> rest;
  std::vector<bool> reversal;
  std::vector<float> velocity_m_per_s;  ///< of the spool; below 1 % of the stroke a second 0: noise has no direction
};

/// From the measured position, whatever was commanded. Fast motion is found from means over 20 ms before and after each
/// sample (longer than a period of dither, > 10 % of the stroke a second and five standard deviations of the noise),
/// slow motion from what fast motion leaves, over half a second (not causal; a judge may look ahead). A turn is where
/// the rate changes sign, with at most half a second of rest in between, or where the motion starts or stops above half
/// of the stroke. Missing positions are held.
[[nodiscard]] Phases phases_of_position(std::span<const double> time_s, std::span<const double> position_m,
                                        double stroke_m);

}  // namespace spoolflow::validation
