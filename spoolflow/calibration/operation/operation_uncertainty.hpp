#pragma once
#include <vector>

#include "spoolflow/calibration/operation/operation_score.hpp"
#include "spoolflow/calibration/operation/replay.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/sensor/observer.hpp"

namespace spoolflow::calibration {

/// The name of that fit.
inline constexpr const char* fit_of_operation = "friction and position sensor in operation";

/// What the operating recordings identify of the parameters of the trial, at which their score is smallest: covariance
/// of an M-estimator (Huber 1967) on a logarithmic scale, from the score's curvature and from how much its slope
/// differs between stretches of some seconds, and from how far a valve's may lie from what it is pulled to: a parameter
/// that the recordings do not identify is uncertain by a factor of two. `pull` is the curvature's half that the weak
/// pull of the search adds. A parameter at the end of its range has uncertainty 0. The score's curvature comes from
/// differences of ten percent: two digits at best.
[[nodiscard]] model::Fit known_of_operation(const std::vector<OperationParameter>& fitted, const OperationTrial& trial,
                                            double full_scale_m3_per_s, double pull);

}  // namespace spoolflow::calibration
