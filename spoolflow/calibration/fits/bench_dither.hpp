#pragma once
/// Solenoid bench recordings with dither on the current: what a slow recorder keeps of it is no more than its alias, so
/// that only means over its periods resolve.
#include "spoolflow/recording/recording.hpp"

namespace spoolflow::calibration {

/// A current is dithered where half its samples differ from the mean of their neighbours by more than this share of the
/// largest current.
inline constexpr double dithered_share = 0.005;
/// What is left of a dithered map [Hz]: below any dither and its usual aliases; 2 % of the stroke at 20 %/s.
inline constexpr double dithered_map_bandwidth_Hz = 10;
/// Slower samples [s] do not resolve dither of up to 250 Hz.
inline constexpr double resolving_step_s = 0.9e-3;

/// Whether the coil current is dithered in those samples that are at least `least_step_s` after the one before.
[[nodiscard]] bool is_dithered(const recording::Recording& recording, double least_step_s);

/// A `solenoid_force_map` as it is, or where its current is dithered, set and measured current, voltage and force as
/// means without delay: the force map under dither. Its loops are narrower than without.
[[nodiscard]] recording::Recording without_dither(const recording::Recording& force_map);

/// Throws CalibrationError where a `solenoid_dynamic` is dithered in tests that were recorded too slowly to resolve
/// it.
void require_resolved_dither(const recording::Recording& solenoid_dynamic);

}  // namespace spoolflow::calibration
