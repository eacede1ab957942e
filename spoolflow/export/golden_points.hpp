#pragma once
/// Inputs and outputs with which an exported sensor proves on its target that it still answers as it did on the host.
#include <vector>

#include "spoolflow/model/model.hpp"

namespace spoolflow::exports {

/// One sample, as the target gets it, and the flow rates [m3/s] in double precision.
struct GoldenPoint {
  sensor::Sample<float> sample;
  double condensed_m3_per_s;
  double best_m3_per_s;  ///< of the observer where the model has one, else of the condensed sensor
};

/// Strokes to and fro with a changing pressure difference, at 1 kHz: closed, sliding both ways, at rest, slipping, a
/// fault of the position sensor, a missing sample, a missing voltage. The currents balance the model's own forces.
[[nodiscard]] std::vector<GoldenPoint> golden_points(const model::Model& model);

/// How far single precision strays from double precision over the golden points on this machine, % of rated flow.
struct SinglePrecisionError {
  double condensed_percent;
  double best_percent;
};
[[nodiscard]] SinglePrecisionError single_precision_error(const model::Model& model,
                                                          const std::vector<GoldenPoint>& points);

}  // namespace spoolflow::exports
