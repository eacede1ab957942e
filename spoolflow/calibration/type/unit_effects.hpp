#pragma once
/// What a unit does at operating points, and what its deviations change of that.
#include <vector>

#include <Eigen/Core>

#include "spoolflow/calibration/type/unit_parameters.hpp"

namespace spoolflow::calibration {

/// The spool slides evenly, all forces in balance.
struct OperatingPoint {
  double position_m, pressure_Pa;
  double current_A;  ///< magnetising, holds spring and flow force
};

struct UnitEffects {
  double force_N;     ///< magnetic force less spring and flow force
  double friction_N;  ///< sliding, of spool and armature, >= 0
  double loop_N;      ///< half width of the magnetic hysteresis
  double conductance;
  double flow_force_N;  ///< closing > 0
};
[[nodiscard]] UnitEffects effects_at(const sensor::ObserverParameters<double>& unit, const OperatingPoint& point);

[[nodiscard]] OperatingPoint balanced_point(const sensor::ObserverParameters<double>& unit, double position_m,
                                            double pressure_Pa);
/// Openings beyond the closed part at pressures from 0.15 of the highest on.
[[nodiscard]] std::vector<OperatingPoint> operating_points(const sensor::ObserverParameters<double>& unit);

/// By what the effects at `points` change over the deviations, one column each, by differences of a fifth of
/// `deviation`: the rows of force [N], then friction [N], then hysteresis [N], then conductance.
struct EffectSlopes {
  std::vector<UnitEffects> here;
  Eigen::MatrixXd force_N, friction_N, loop_N, conductance;
};
[[nodiscard]] EffectSlopes effect_slopes(const sensor::ObserverParameters<double>& unit,
                                         const std::vector<OperatingPoint>& points, const Eigen::VectorXd& deviation);

}  // namespace spoolflow::calibration
