#pragma once
/// Whether a campaign's recordings can be of one valve, and if not, which usual slip explains them.
#include <vector>

#include "spoolflow/consistency/doubt.hpp"
#include "spoolflow/recording/recording.hpp"

namespace spoolflow::consistency {

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

/// The worst first; empty where nothing speaks against them. Each slip that explains what nothing else does is named;
/// nothing is corrected.
[[nodiscard]] std::vector<Doubt> doubts_about(const Benches& benches);

}  // namespace spoolflow::consistency
