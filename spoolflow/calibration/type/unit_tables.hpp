#pragma once
/// Two units of a type beside each other, table by table.
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "spoolflow/calibration/type/unit_effects.hpp"
#include "spoolflow/calibration/type/unit_parameters.hpp"

namespace spoolflow::calibration {

/// What one unit's tables of spring, magnetic force, flux linkage, hysteresis, resistance, flow, flow force and
/// friction have beyond those of another that deviates.
class TableComparison {
 public:
  /// Keeps both by reference. `balance_N` is given where no force rig measured the newtons of one of them: a common
  /// factor of all forces then counts for nothing, and magnetic, spring and flow force are compared by what their
  /// balance leaves, to within so much. Motion on a flow bench shows no more.
  TableComparison(const sensor::ObserverParameters<double>& base, const sensor::ObserverParameters<double>& unit,
                  std::optional<double> balance_N = {});

  /// Base with `deviations`, less the unit: each row over what a campaign's own fit leaves of it.
  [[nodiscard]] Eigen::VectorXd rows(const Deviations& deviations) const;
  /// What each row counts where so much is left: all rows of a table as a few, fewer where the directions do not
  /// explain the table to within what its fit leaves.
  [[nodiscard]] Eigen::VectorXd weights(const Eigen::VectorXd& left) const;
  /// Root mean square over openings and pressures of what is left of magnetic force less spring and flow force, at the
  /// currents that balance.
  [[nodiscard]] double force_left_N(const Deviations& deviations) const;

 private:
  const sensor::ObserverParameters<double>& base_;
  const sensor::ObserverParameters<double>& unit_;
  std::optional<double> balance_N_;
  std::vector<OperatingPoint> balanced_;  ///< where the base's forces balance; empty without `balance_N`
  Eigen::VectorXd of_unit_;
  std::vector<Eigen::Index> ends_;  ///< of each table's rows
};

}  // namespace spoolflow::calibration
