#pragma once
/// The strokes by which a unit of a type is known best in the time that there is.
#include <string>
#include <vector>

#include "spoolflow/calibration/type/map_estimate.hpp"
#include "spoolflow/model/model.hpp"

namespace spoolflow::calibration {

/// A corner of the course: straight lines lead from one to the next.
struct PlannedCorner {
  double time_s, position_share, pressure_Pa;  ///< position as a share of the stroke
};

/// Strokes of one rate from the closed end to the open one and back, each at a held pressure difference.
struct PlannedMinute {
  double rate_per_s;                 ///< shares of the stroke
  std::vector<double> pressures_Pa;  ///< one a stroke, rising; 0: the pump's pressure off the valve
  /// Standard uncertainty of the flow that the unit's deviations leave, root mean square over openings, pressures and
  /// both directions, as a share of the rated flow: of any unit of the type, and of one that was recorded so.
  double before_share, after_share;
  KnownDeviations after;  ///< what is known of such a unit's deviations; the mean is the type's
  bool both_ways =
      false;  ///< of a whole valve: at each pressure P to B, then P to A with position < 0; all is of P to B

  [[nodiscard]] std::vector<PlannedCorner> corners() const;
};
/// At the open end; and closed, before and after each stroke.
inline constexpr double planned_hold_s = 0.5, planned_pause_s = 0.5;

/// Least mean variance of the flow over the operating range (I-optimal) after calibrate_unit() of the strokes recorded
/// with flow meter and pressure difference; every rate of a few with the pressures that exchange finds for it.
/// Recordings with dither show no friction and no force row, so that the plan has none. Of a whole valve the strokes
/// are chosen for its direction P to B. Throws CalibrationError where `type`, from `file`, is no type's model or no
/// stroke fits into `seconds`.
[[nodiscard]] PlannedMinute plan_minute(const model::Model& type, const std::string& file, double seconds);

/// The type's middle, of one direction, as a unit that was recorded so: its band is as wide as that unit's will be.
[[nodiscard]] model::Model planned_unit(const model::Model& type, const PlannedMinute& minute);

}  // namespace spoolflow::calibration
