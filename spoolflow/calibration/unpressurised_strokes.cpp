#include "spoolflow/calibration/unpressurised_strokes.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/numerics/median.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::calibration {
namespace {

using recording::Channel;

/// Median of what was measured; 0 where nothing was.
double median_of(const recording::Recording& recording, Channel channel) {
  const double median = numerics::median(recording.column(channel));
  return std::isnan(median) ? 0 : median;
}

/// What the spool travelled at most in one go [m], opening and closing.
struct Travel {
  double opened_m = 0, closed_m = 0;
};
Travel travel_of(const recording::Recording& recording) {
  Travel out;
  double lowest_m = INFINITY, highest_m = -INFINITY;
  for (const double position_m : recording[Channel::position]) {
    if (!std::isfinite(position_m)) continue;
    lowest_m = std::min(lowest_m, position_m);
    highest_m = std::max(highest_m, position_m);
    out.opened_m = std::max(out.opened_m, position_m - lowest_m);
    out.closed_m = std::max(out.closed_m, highest_m - position_m);
  }
  return out;
}

}  // namespace

std::string not_unpressurised(const recording::Recording& recording, double rated_flow_m3_per_s, double stroke_m) {
  const std::string file = recording.file.filename().string();
  const double pressure_Pa = median_of(recording, Channel::pressure_difference);
  if (std::abs(pressure_Pa) > unpressurised_Pa) {
    return fmt::format(
        "{}: channel pressure_difference is {:.1f} bar in the middle, at most {:g} bar is without pressure; record the "
        "strokes with the pump off, or name the run protocol = \"operation\"",
        file, units::bar_from_Pa(pressure_Pa), units::bar_from_Pa(unpressurised_Pa));
  }
  const double flow_m3_per_s = median_of(recording, Channel::flow_reference);
  if (std::abs(flow_m3_per_s) > unpressurised_flow_share * rated_flow_m3_per_s) {
    return fmt::format(
        "{}: channel flow_reference is {:.2f} L/min in the middle, at most {:.2f} L/min is without pressure; record "
        "the strokes with the pump off, or name the run protocol = \"operation\"",
        file, units::L_per_min_from_m3_per_s(flow_m3_per_s),
        units::L_per_min_from_m3_per_s(unpressurised_flow_share * rated_flow_m3_per_s));
  }
  const Travel travel = travel_of(recording);
  if (std::min(travel.opened_m, travel.closed_m) >= least_stroke_share * stroke_m) return {};
  return fmt::format(
      "{}: channel position opens by {:.2f} mm and closes by {:.2f} mm at most, and strokes need {:.2f} mm each way; "
      "record whole strokes, slowly both ways",
      file, units::mm_from_m(travel.opened_m), units::mm_from_m(travel.closed_m),
      units::mm_from_m(least_stroke_share * stroke_m));
}

}  // namespace spoolflow::calibration
