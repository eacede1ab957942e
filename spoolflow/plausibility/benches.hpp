#pragma once
/// A campaign's recordings of one direction of flow, as its checks take them.
#include <vector>

#include "spoolflow/recording/recording.hpp"

namespace spoolflow::plausibility {

/// The recordings of one direction of flow, opening > 0. Null and empty where there are none.
struct Benches {
  const recording::Recording* spring = nullptr;
  const recording::Recording* solenoid_force_map = nullptr;
  std::vector<const recording::Recording*> solenoid_dynamic{};
  std::vector<const recording::Recording*> axial_force_maps{};  ///< of both edges together, or of one of them
  std::vector<const recording::Recording*> operation{};
  double rated_flow_m3_per_s = 0;  ///< > 0
  double stroke_m = 0;             ///< > 0
  double density_kg_per_m3 = 870;
};

}  // namespace spoolflow::plausibility
