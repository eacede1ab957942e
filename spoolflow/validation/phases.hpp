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
  bool from_measured_position = false;  ///< no position_set was recorded
};

/// From the commanded position as a share of the stroke. A turn is where its rate changes sign, or where the motion
/// starts or stops above half of the stroke.
[[nodiscard]] Phases phases_of_command(std::span<const double> time_s, std::span<const double> position_set);
/// From the measured position: its rate over half a second around each sample (not causal; a judge may look ahead).
/// A change of direction with less than half a second of rest in between is a turn as well. Missing positions are held.
[[nodiscard]] Phases phases_of_position(std::span<const double> time_s, std::span<const double> position_m,
                                        double stroke_m);

}  // namespace spoolflow::validation
