#pragma once
/// Inputs and outputs with which an exported sensor proves on its target that it still answers as it did on the host.
#include <vector>

#include "spoolflow/model/model.hpp"
#include "spoolflow/sensor/whole_valve/whole_valve_sample.hpp"

namespace spoolflow::exports {

/// One sample, as the target gets it, and the answers in double precision.
template <class Sample>
struct GoldenPoint {
  Sample sample;
  double condensed_m3_per_s;
  double best_m3_per_s;        ///< of the observer where the model has one, else of the condensed sensor
  double best_lower_m3_per_s;  ///< its band
  double best_upper_m3_per_s;
  sensor::Status best_status;
};
using DirectionPoint = GoldenPoint<sensor::Sample<float>>;
using WholeValvePoint = GoldenPoint<sensor::WholeValveSample<float>>;

/// Of a model of one direction: strokes to and fro with a changing pressure difference, at 1 kHz: closed, sliding both
/// ways, at rest, slipping, a fault of the position sensor, a missing sample, a missing voltage. The currents balance
/// the model's own forces.
[[nodiscard]] std::vector<DirectionPoint> golden_points(const model::Model& model);

/// Of a whole valve: the same strokes to one side and then to the other, while the first solenoid's current fades.
[[nodiscard]] std::vector<WholeValvePoint> whole_golden_points(const model::Model& model);

/// How far single precision strays from double precision over the golden points on this machine, % of rated flow.
struct SinglePrecisionError {
  double condensed_percent;
  double best_percent;
};
[[nodiscard]] SinglePrecisionError single_precision_error(const model::Model& model,
                                                          const std::vector<DirectionPoint>& points);
[[nodiscard]] SinglePrecisionError single_precision_error(const model::Model& model,
                                                          const std::vector<WholeValvePoint>& points);

}  // namespace spoolflow::exports
