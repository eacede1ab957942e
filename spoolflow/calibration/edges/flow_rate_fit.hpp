#pragma once
/// Inversion of the flow-force map: from force and position to flow rate (paper section 3).
#include <vector>

#include "spoolflow/calibration/fits/axial_force.hpp"
#include "spoolflow/sensor/flow_rate.hpp"
#include "spoolflow/sensor/force_maps.hpp"

namespace spoolflow::calibration {

/// One position of the flow-force map: force, flow and pressure difference at each level, rising pressure difference.
struct FlowForceColumn {
  double position_m;
  std::vector<double> flow_force_N;  ///< both directions averaged, less the spring; closing > 0
  std::vector<double> flow_m3_per_s;
  std::vector<double> pressure_difference_Pa;
};

/// The map position by position, as measured: not yet made monotone.
[[nodiscard]] std::vector<FlowForceColumn> flow_force_columns(const std::vector<model::AxialForceLoop>& loops,
                                                              const sensor::Spring<double>& spring);

/// Inverts each column by a monotone cubic over the root of the force, which at a fixed opening is nearly linear in
/// flow. Where forces of different levels do not rise, they are pooled (see uniqueness.hpp for where that is). The
/// origin (no force, no flow, no pressure difference) belongs to every column. `least_force_N` > 0 bounds the largest
/// force of columns in which no force was measured.
[[nodiscard]] sensor::FlowRate<double> invert_flow_force(const std::vector<FlowForceColumn>& columns,
                                                         double least_force_N);

}  // namespace spoolflow::calibration
