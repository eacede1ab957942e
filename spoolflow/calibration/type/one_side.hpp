#pragma once
/// One direction's part of a run of the whole valve.
#include <string>

#include "spoolflow/recording/recording.hpp"

namespace spoolflow::calibration {

struct OneSide {
  recording::Recording run;
  double closed_m;  ///< what its position reads where the valve is closed
};

/// The run as a valve of that direction alone ("b": P to B, "a": P to A) would show it: its coil, position and flow > 0
/// where it opens. While the spool stands on the other side it reads as closed, without flow. `stroke_m` is of one
/// direction. Throws CalibrationError where the spool never rests in the centre without current, for a hundred samples,
/// which shows where closed reads.
[[nodiscard]] OneSide one_side(const recording::Recording& whole, const std::string& direction, double stroke_m);

}  // namespace spoolflow::calibration
