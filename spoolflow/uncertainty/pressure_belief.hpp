#pragma once
/// What the observer's own state leaves open of the pressure difference, beyond the errors of its forces: changes of
/// the supply that no force has shown yet.
#include "spoolflow/sensor/observer.hpp"

namespace spoolflow::uncertainty {

/// A normal error of the pressure difference, cut off where friction at rest would lie outside its bounds, and what it
/// makes of the flow rate. Errors are estimate less truth.
class PressureBelief {
 public:
  struct Parts {
    double deviation_Pa = 0;
    double below_Pa = 0, above_Pa = 0;  ///< errors lie from -below to +above; infinite while the spool slides
    double bounds_Pa = 0;               ///< one standard deviation of these bounds
    double pressure_difference_Pa = 0;  ///< as estimated
    double highest_Pa = 0;              ///< that the maps know
    double conductance = 0;             ///< flow over the root of the pressure difference
  };
  PressureBelief() = default;
  explicit PressureBelief(const Parts& parts);

  /// Root mean square.
  [[nodiscard]] double standard_uncertainty_Pa() const { return standard_uncertainty_Pa_; }
  /// Half the flow rate's change from one standard uncertainty above to one below.
  [[nodiscard]] double flow_uncertainty_m3_per_s() const;
  /// The flow rate's error at that quantile of the pressure's: `normal` is a standard normal number, 0 no error.
  [[nodiscard]] double flow_error_m3_per_s(double normal) const;

 private:
  [[nodiscard]] double flow_error_of_m3_per_s(double error_Pa) const;

  Parts parts_;
  double below_share_ = 0, above_share_ = 1;  ///< of the normal distribution at its cuts
  double widening_ = 1;                       ///< by what the bounds' own uncertainty adds
  double standard_uncertainty_Pa_ = 0;
};

/// After an observer's answer to a sample at `position_m`, `step_s` after the one before. Unseen changes count as in
/// the observer's band, the band's factor as 95 %. While the spool slides comes the lag of its filter behind a pressure
/// that drifts as the filter expects: half the variance of its steady state, which is drift times noise; the other half
/// is the forces' errors, which have lines of their own. At rest friction lies within its half-width by pre-sliding
/// displacement.
[[nodiscard]] PressureBelief pressure_belief(const sensor::ObserverParameters<double>& valve,
                                             const sensor::ObserverState<double>& state, double position_m,
                                             double step_s);

}  // namespace spoolflow::uncertainty
