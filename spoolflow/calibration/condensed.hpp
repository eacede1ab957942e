#pragma once
/// Calibration of the paper's condensed sensor from the bench recordings of a campaign.
#include "spoolflow/calibration/edges/path_of_edges.hpp"
#include "spoolflow/calibration/flow_bench/equivalent_benches.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/recording/recording.hpp"

namespace spoolflow::calibration {

struct CondensedRecordings {
  const recording::Recording& spring;
  const recording::Recording& solenoid_force_map;
  AxialForceMaps axial_force_maps;
  const EquivalentBenches* flow_bench = nullptr;  ///< where some of them are from there
};

struct CondensedCalibration {
  model::Condensed condensed;
  model::Evidence evidence;
};

/// Spring, magnetic-force map, flow-force map, inversion, uniqueness and sensitivity in turn. Of several oil
/// temperatures the middle one is used: the condensed sensor has one map. Throws CalibrationError.
[[nodiscard]] CondensedCalibration calibrate_condensed(const CondensedRecordings& recordings,
                                                       const model::Valve& valve);

}  // namespace spoolflow::calibration
