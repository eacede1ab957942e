#pragma once
/// How much of the stated force errors the observer's band must count: what they do to the flow while the valve works
/// shows, beside a reference flow, whether they are as large as the benches' residuals make them. And what operating
/// recordings leave unknown of the parameters that are fitted to them.
#include <vector>

#include "spoolflow/calibration/operation/operation_score.hpp"
#include "spoolflow/calibration/operation/replay.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/sensor/observer.hpp"

namespace spoolflow::calibration {

/// Without an operating recording: wider than any of the valves that were tried needs (docs/accuracy.md).
inline constexpr double assumed_force_error_ratio = 2;
/// Eleven of twelve models of rig valves, and valve A's, have tolerances of friction at rest from 0.8 to 1.4 N.
inline constexpr double largest_usual_tolerance_N = 1.4;

/// One run may agree better with the benches than others will.
inline constexpr double least_force_error_ratio = 0.4;

/// Dither, which bounds friction, does not show the force errors at rest without it: no less than this
/// where no recording shows such a rest.
inline constexpr double least_dithered_force_error_ratio = 1;

/// Forces that no force bench measured were fitted to runs like the one that this ratio is found on. Dither or a faster
/// spool show errors of hysteresis and friction that hide each other in such runs.
inline constexpr double least_inferred_force_error_ratio = 0.7;
/// ... and more so where these are the very strokes from which the forces were inferred: with 0.7 the bands of the
/// rig's size 6 hold 88 % of its flow, with this 98 %.
inline constexpr double least_stroke_force_error_ratio = 1.4;

/// A supply is restless where the pressure difference has moved since the spool last slid in more than this share of
/// the samples at rest: ...
inline constexpr double restless_share = 0.1;
/// ... its errors are not those of the forces, and the band itself shows how wide it must be, to hold this share of the
/// reference.
inline constexpr double needed_coverage = 0.97;

/// RMS error of the flow at rest over what one standard deviation of the forces makes of it, the meter's lag and noise
/// taken out. At rest nothing averages the forces' errors. On a restless supply less, where the band holds the
/// reference with less. The assumed ratio where the spool never rests open; never less than the least.
[[nodiscard]] double force_error_ratio(const sensor::ObserverParameters<double>& parameters,
                                       const std::vector<OperatingRun>& runs);

/// Sets what the band counts in proportion to that ratio.
void scale_band(sensor::ObserverParameters<double>& parameters, double force_error_ratio);

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
