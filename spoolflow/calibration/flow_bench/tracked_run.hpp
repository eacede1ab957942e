#pragma once
/// A recording on the flow bench as the sensor sees it: coil, position track, and where the spool slides.
#include <vector>

#include "spoolflow/calibration/fits/solenoid_samples.hpp"
#include "spoolflow/recording/recording.hpp"

namespace spoolflow::calibration {

/// A sample in which the spool slides, without dither: friction has its full size and its sign is known.
struct SlidingSample {
  std::size_t sample;
  double position_m;  ///< the closed spool reads zero
  double direction;   ///< 1 opening, -1 closing
  double acceleration_m_per_s2;
  double pressure_difference_Pa;
};

struct TrackedRun {
  SolenoidSamples coil;      ///< without force; current and voltage as means over the step, the closed spool reads zero
  double oil_temperature_K;  ///< mean; NaN where it was not recorded
  std::vector<SlidingSample>
      sliding;  ///< evenly: some of each millisecond's, away from the ends of the stroke and from reversals
  std::vector<SlidingSample> passing;  ///< the same of a spool that goes one way evenly or by sticking and slipping
  int edge = 0;                        ///< 1: of the outlet alone
};

/// Position by the sensor's own track. `pressurised` is false for strokes with the pump off: whatever was measured of a
/// pressure difference is then taken as none. Samples without current or position are left out.
[[nodiscard]] TrackedRun track_run(const recording::Recording& recording, double stroke_m, bool pressurised);

/// The measured pressure difference of each sample [Pa], from whichever channels there are; empty where there is none.
[[nodiscard]] std::vector<double> pressure_difference_Pa(const recording::Recording& recording);

}  // namespace spoolflow::calibration
