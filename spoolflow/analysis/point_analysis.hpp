#pragma once
/// The budget at chosen points, checked by Monte Carlo, and over the whole operating map.
#include <functional>

#include "spoolflow/analysis/monte_carlo.hpp"
#include "spoolflow/analysis/scenario.hpp"

namespace spoolflow::analysis {

/// One estimator at one working point.
struct PointResult {
  estimation::Estimator estimator{};
  uncertainty::WorkingPoint point{};
  bool reachable = false;  ///< false: the estimator's maps do not hold the point, nothing below is set
  double current_A = 0;
  double position_reading_m = 0;
  double flow_m3_per_s = 0;
  uncertainty::Budget budget;
  MonteCarlo check;
  StatedInterval stated;
};

/// The points that a scenario names, at the map's oil temperature where it names none.
[[nodiscard]] std::vector<uncertainty::WorkingPoint> working_points(const model::Model& model,
                                                                    const PointSettings& settings);

/// Every estimator at every point. `progress` receives the share done.
[[nodiscard]] std::vector<PointResult> analyse_points(const model::Model& model, const Scenario& scenario,
                                                      unsigned workers, const std::function<void(double)>& progress);

/// A cell of the operating map.
struct MapCell {
  bool reachable = false;
  double flow_m3_per_s = 0, expanded_m3_per_s = 0;
  uncertainty::InputQuantity dominant{};  ///< with the largest share of the variance
  double dominant_share = 0;
};

/// Local sensitivity of one estimator: cells row after row, rows over rising pressure difference.
struct OperatingMap {
  estimation::Estimator estimator;
  std::vector<double> position_m, pressure_difference_Pa;
  std::vector<MapCell> cells;
};

[[nodiscard]] std::vector<OperatingMap> operating_maps(const model::Model& model, const Scenario& scenario,
                                                       unsigned workers, const std::function<void(double)>& progress);

}  // namespace spoolflow::analysis
