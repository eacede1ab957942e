#pragma once
/// What of the valve the operating recordings at hand identify: under dither no rest shows how friction grows or where
/// the contacts lie, and without dither or fast strokes nothing shows the mass.
#include <vector>

#include "spoolflow/calibration/operation/operation_score.hpp"

namespace spoolflow::calibration {

/// Rest without dither, the valve open, that identifies friction at rest [s], all recordings together.
inline constexpr double least_undithered_rest_s = 2;
/// A parameter is identifiable where half or twice its value makes the score worse or better by this share of it.
inline constexpr double least_score_share = 0.01;

/// How long the spool rests open without dither [s].
[[nodiscard]] double undithered_rest_s(const sensor::ObserverParameters<double>& parameters,
                                       const std::vector<OperatingRun>& runs);

/// What friction without dither is taken for where no rest without dither shows it: what of it is too small, the sensor
/// takes for pressure, and how it changes with the speed of sliding is not known.
void assume_rest(sensor::ObserverParameters<double>& parameters);

/// Those of all parameters that these recordings identify.
[[nodiscard]] std::vector<OperationParameter> identifiable_parameters(const OperationTrial& trial,
                                                                      double full_scale_m3_per_s);

}  // namespace spoolflow::calibration
