#include "spoolflow/calibration/fits/spring_fit.hpp"

#include <algorithm>
#include <cmath>

#include "spoolflow/calibration/fits/bench_strokes.hpp"
#include "spoolflow/calibration/fits/both_directions.hpp"
#include "spoolflow/calibration/fits/sliding_friction.hpp"
#include "spoolflow/calibration/numerics/calibration_error.hpp"
#include "spoolflow/calibration/numerics/fitted_parameters.hpp"
#include "spoolflow/calibration/numerics/interpolation.hpp"
#include "spoolflow/calibration/numerics/linear_least_squares.hpp"

namespace spoolflow::calibration {

using recording::Channel;

namespace {

/// What the strokes leave about the spring and one dry friction each way: how much friction depends on the position.
FitResidual even_friction(const recording::Recording& recording, const Level& level,
                          const sensor::Spring<double>& spring) {
  constexpr double bandwidth_Hz = 10;  // of strokes that take seconds
  const auto time_s = recording[Channel::time];
  const auto position_m = recording[Channel::position];
  const auto force_N = recording[Channel::axial_force];
  std::vector<double> friction_N;
  for (std::size_t k = 0; k < position_m.size(); ++k)
    friction_N.push_back(std::isnan(position_m[k]) ? std::nan("") : force_N[k] - spring.at(position_m[k]).value);
  return fit_sliding_friction({.position_m = position_m,
                               .force_N = friction_N,
                               .time_step_s = (time_s.back() - time_s.front()) / static_cast<double>(time_s.size() - 1),
                               .bandwidth_Hz = bandwidth_Hz,
                               .stretches = level.sweeps},
                              FrictionSymmetry::by_direction, FrictionMotion::even_strokes)
      .residual;
}

/// Preload, stiffness and dry friction, as though the spring were straight and friction the same at all positions.
model::Fit straight_spring(const recording::Recording& recording, const Level& level) {
  const auto position_m = recording[Channel::position];
  const auto force_N = recording[Channel::axial_force];
  std::vector<Eigen::Vector4d> rows;
  for (const Sweep& sweep : level.sweeps) {
    const double sign = sweep.direction == Direction::opening ? 1 : -1;
    for (std::size_t k = sweep.begin; k < sweep.end; ++k)
      if (!std::isnan(position_m[k]) && !std::isnan(force_N[k])) rows.emplace_back(1, position_m[k], sign, force_N[k]);
  }
  const Eigen::MatrixXd all = stacked(rows);
  const LinearLeastSquares fit = least_squares(all.leftCols(3), all.col(3), "the spring");
  return known_from_samples("spring as a straight line, dry friction of the spool",
                            {"spring_preload_N", "spring_stiffness_N_per_m", "dry_friction_N"}, fit);
}

}  // namespace

SpringFit fit_spring(const recording::Recording& recording, double stroke_m) {
  const std::string file = recording.file.filename().string();
  const auto position_m = recording[Channel::position];
  const auto force_N = recording[Channel::axial_force];
  const Level level{0.0, find_bench_strokes(position_m, stroke_m)};
  require_both_directions(level, file);

  const std::vector<double> grid_m = equally_spaced(0, stroke_m, sensor::spring_positions);
  const BothDirections force =
      without_breakaway(average_both_directions({level, position_m, force_N}, grid_m, file + ": spring force"),
                        wearing_stroke_share * stroke_m);
  const std::vector<double> mean_N = force.mean();

  SpringFit fit{};
  fit.spring.curve.axis = {0, grid_m[1], 1 / grid_m[1]};
  std::copy(mean_N.begin(), mean_N.end(), fit.spring.curve.values.begin());
  fit.friction_half_width_N = force.half_width();
  sensor::Curve<double, sensor::spring_positions> half_width{fit.spring.curve.axis, {}};
  std::copy(fit.friction_half_width_N.begin(), fit.friction_half_width_N.end(), half_width.values.begin());
  for (const Sweep& sweep : level.sweeps) {
    const double sign = sweep.direction == Direction::opening ? 1 : -1;
    for (std::size_t k = sliding_part(sweep, position_m, stroke_m).begin; k < sweep.end; ++k) {
      fit.residual.add(force_N[k] - fit.spring.at(position_m[k]).value - sign * half_width.at(position_m[k]).value);
    }
  }
  fit.even_friction_residual = even_friction(recording, level, fit.spring);
  fit.known = straight_spring(recording, level);
  fit.oil_temperature_K = mean_oil_temperature_K(recording);
  return fit;
}

}  // namespace spoolflow::calibration
