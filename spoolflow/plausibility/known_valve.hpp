#pragma once
/// The valve that a run is held against, as its model or its benches know it.
#include <vector>

#include "spoolflow/model/model.hpp"
#include "spoolflow/plausibility/benches.hpp"
#include "spoolflow/plausibility/position_zero.hpp"
#include "spoolflow/plausibility/signals/known_coil.hpp"
#include "spoolflow/plausibility/valve_curves.hpp"

namespace spoolflow::plausibility {

/// One direction of a calibrated valve, from the strokes that its model keeps as evidence.
struct KnownValve {
  HydraulicCurves hydraulics;
  MagneticCurves magnetics;
  KnownCoil coil;                        ///< its flux linkage is known of a model of one direction
  double position_noise_m = 0;           ///< of a sample, as calibrated; 0: not known
  model::Range oil_temperature_K{0, 0};  ///< as calibrated; 0: not known
  OpeningCurve opening{};                ///< empty: not known
  double closed_below_m = 0;             ///< the spool covers the edge there; 0: not known
  bool open_stop_is_known = false;
};

/// The model's directions: "b", or "a" of a model of that alone, and then "a" of a whole valve.
[[nodiscard]] std::vector<KnownValve> known_valve(const model::Model& model);

/// One direction straight from its bench recordings; needs spring, force map and axial-force maps.
[[nodiscard]] KnownValve known_valve(const Benches& benches);

}  // namespace spoolflow::plausibility
