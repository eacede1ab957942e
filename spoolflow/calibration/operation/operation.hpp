#pragma once
/// What no bench test shows, from recordings of the valve at work with a reference flow: how friction in operation
/// compares with that on the bench, its growth at rest, the contacts' stiffness, the backlash of the position sensor,
/// and how wide the band must be. These recordings are then no independent test any more. The paper models none of it
/// (2.1.3 and section 4 name the friction).
#include <functional>
#include <string>
#include <vector>

#include "spoolflow/calibration/numerics/fit_residual.hpp"
#include "spoolflow/calibration/operation/replay.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/numerics/meter_lag.hpp"
#include "spoolflow/recording/recording.hpp"
#include "spoolflow/sensor/observer.hpp"

namespace spoolflow::calibration {

/// The valve of the operating recordings.
struct InOperation {
  double rated_flow_m3_per_s;
  double least_ratio = 0;          ///< the force error ratio is taken for no less
  bool friction_is_known = false;  ///< that of sliding, from this valve as a whole
  bool mass_is_declared = false;   ///< the moving mass is not searched for
};

/// How well the observer does on the operating recordings.
struct OperationFit {
  double score_before;  ///< see operation_score; both with the supply and the band's scale of the search
  double score;
  std::vector<numerics::MeterLag> meters;  ///< of the recordings, as they show it
  model::Fit known;                        ///< of the parameters that were searched, see operation_uncertainty.hpp
  std::vector<std::string>
      not_identifiable;       ///< parameters that these recordings do not identify, see identifiable_parameters.hpp
  FitResidual flow_m3_per_s;  ///< estimate less reference, with the fitted parameters
  double force_error_ratio;   ///< see force_error_ratio(); the band is scaled by it
  double band_coverage;       ///< share of the samples with the reference inside the band
  std::size_t samples;        ///< that were used: see replay.hpp
};

/// Pattern search of the smallest score, each parameter on a logarithmic scale inside its stated range, with a pull
/// towards the values that `parameters` holds: a weak one, or where it is known a strong one. Recordings need time,
/// current, position and flow_reference; their meters are found. `progress` receives the share done.
OperationFit fit_operation(sensor::ObserverParameters<double>& parameters, const std::vector<OperatingRun>& recorded,
                           const InOperation& valve, const std::function<void(double)>& progress);

}  // namespace spoolflow::calibration
