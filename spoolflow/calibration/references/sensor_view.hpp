#pragma once
/// Recordings of operation as a valve's sensor sees them.
#include <optional>
#include <vector>

#include "spoolflow/calibration/references/passed_oil.hpp"
#include "spoolflow/sensor/observer_parameters.hpp"
#include "spoolflow/sensor/pressure_difference.hpp"

namespace spoolflow::calibration {

/// A recording, and what passed the valve in it by what the machine knows.
struct WatchedRun {
  const recording::Recording* recording;
  std::vector<PassedOil> oil;
};

struct SensorView {
  std::vector<double> volume_m3;  ///< the sensor's, of each interval, run after run
  double breakaway_loss;          ///< of all break-aways while oil passes
};

/// Of one break-away, as negative logarithm of the likelihood of its force in newtons, from the state of the pressure
/// difference before and after it; nothing where it took nothing from the variance.
[[nodiscard]] std::optional<double> breakaway_loss(const sensor::PressureState<double>& prior,
                                                   const sensor::PressureState<double>& posterior,
                                                   double slope_N_per_Pa);

/// All runs through the sensor with these parameters, each from its beginning.
[[nodiscard]] SensorView view_through(const sensor::ObserverParameters<double>& valve, double rated_flow_m3_per_s,
                                      const std::vector<WatchedRun>& runs);

/// Where the spool stands closed without current [m], free of the drift that the model knows: median of the readings
/// from a tenth of a second after the current is gone. Nothing where it stands so for less than 0.3 s.
[[nodiscard]] std::optional<double> closed_reading_m(const sensor::ObserverParameters<double>& valve,
                                                     const recording::Recording& recording);

}  // namespace spoolflow::calibration
