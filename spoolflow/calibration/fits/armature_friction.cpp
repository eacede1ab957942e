#include "spoolflow/calibration/fits/armature_friction.hpp"

#include <algorithm>

#include "spoolflow/calibration/fits/bench_strokes.hpp"
#include "spoolflow/calibration/fits/both_directions.hpp"
#include "spoolflow/calibration/fits/flux_evidence.hpp"
#include "spoolflow/calibration/fits/map_residuals.hpp"
#include "spoolflow/calibration/numerics/fitted_parameters.hpp"
#include "spoolflow/calibration/numerics/interpolation.hpp"
#include "spoolflow/calibration/numerics/linear_least_squares.hpp"
#include "spoolflow/calibration/numerics/nonnegative_least_squares.hpp"

namespace spoolflow::calibration {
namespace {

constexpr int rows = sensor::force_map_currents;
constexpr int columns = sensor::force_map_positions;

/// Columns known at the held currents onto the map's rows; below the first current the trend of the first two goes on.
void over_rows(FrictionMap& map, const std::vector<double>& currents_A, const std::vector<std::vector<double>>& known) {
  std::vector<double> rows_A;
  for (int row = 0; row < rows; ++row) rows_A.push_back(map.row_axis.at(row));
  std::vector<double> at_A(currents_A);
  at_A.insert(at_A.begin(), std::min(0.0, currents_A.front() - 1e-6));
  for (int column = 0; column < columns; ++column) {
    const auto c = static_cast<std::size_t>(column);
    std::vector<double> values;
    for (const std::vector<double>& level : known) values.push_back(level[c]);
    const double slope = (values[1] - values[0]) / (currents_A[1] - currents_A[0]);
    values.insert(values.begin(), values[0] - slope * (currents_A[0] - at_A[0]));
    const std::vector<double> onto = interpolate_monotone({at_A, values}, rows_A);
    for (int row = 0; row < rows; ++row) map.node(row, column) = onto[static_cast<std::size_t>(row)];
  }
}

/// The map's force, going on along its slope where the magnetising current leaves the held currents by the width of a
/// loop.
double force_beyond(const sensor::MagneticForce<double>& magnetic_force, double current_A, double position_m) {
  const double edge_A = magnetic_force.map.row_axis.at(rows - 1);
  const auto force = magnetic_force.at(current_A, position_m);
  return force.value + force.row_slope * std::max(0.0, current_A - edge_A);
}

struct Strokes {
  const std::vector<Level>& levels;
  const std::vector<double>& position_m;
  const std::vector<double>& magnetising_A;
};

/// What map and friction leave of the strokes, and friction as a constant and a share.
void take_residuals(ArmatureFrictionFit& fit, const SolenoidSamples& samples, const Strokes& strokes, double stroke_m) {
  std::vector<Eigen::Vector3d> taken;
  for (const Level& level : strokes.levels) {
    ResidualProfile profile(stroke_m);
    for (const Sweep& sweep : level.sweeps) {
      const double sign = sweep.direction == Direction::opening ? 1 : -1;
      for (std::size_t k = sweep.begin; k < sweep.end; ++k) {
        const double position_m = strokes.position_m[k], current_A = strokes.magnetising_A[k];
        const double magnetic_N = force_beyond(fit.magnetic_force, current_A, position_m);
        taken.emplace_back(-sign, -sign * magnetic_N, samples.force_N[k] - magnetic_N);
        const double left_N = taken.back()(2) + sign * fit.friction_N.at(current_A, position_m).value;
        fit.residual.add(left_N);
        profile.add(position_m, left_N);
      }
    }
    fit.profiles.push_back(profile.at(level.value, 0));
  }
  const Eigen::MatrixXd all = stacked(taken);
  fit.known = known_from_samples("armature friction as a constant and a share of the magnetic force",
                                 {"constant_friction_N", "friction_per_magnetic_force"},
                                 least_squares(all.leftCols(2), all.col(2), "the armature's friction"));
}

/// Covariance of the solution, from those unknowns that are not held at zero; the last column is the right side.
Eigen::MatrixXd covariance_among_free(const Eigen::MatrixXd& all, const Eigen::VectorXd& solution) {
  const std::vector<Eigen::Index> free = above_zero(solution);
  if (free.empty()) return Eigen::MatrixXd::Zero(solution.size(), solution.size());
  const LinearLeastSquares fit = least_squares(all(Eigen::all, free), all.col(solution.size()), "the loops' widths");
  return spread_over(solution.size(), free, fit.covariance(independent_in_a_row(fit.deviation)));
}

}  // namespace

ArmatureFrictionFit fit_armature_friction(const SolenoidSamples& samples, const MagneticForceFit& map,
                                          const sensor::Coil<double>& coil, double stroke_m) {
  ArmatureFrictionFit fit{};
  fit.magnetic_force = map.magnetic_force;
  const auto& force_map = fit.magnetic_force.map;
  fit.friction_N.row_axis = force_map.row_axis;
  fit.friction_N.column_axis = force_map.column_axis;
  const std::vector<double> magnetising_A = magnetising_currents_A(samples, coil);

  std::vector<double> position_m;
  std::vector<double> current_A;
  std::vector<double> deviation_N;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    position_m.push_back(samples.samples[k].position_m);
    current_A.push_back(samples.samples[k].current_A);
    deviation_N.push_back(samples.force_N[k] - force_beyond(fit.magnetic_force, magnetising_A[k], position_m[k]));
  }
  const std::vector<Level> levels = sort_by_level(find_bench_strokes(position_m, stroke_m), current_A);
  const std::vector<double> grid_m =
      equally_spaced(force_map.column_axis.first, force_map.column_axis.at(columns - 1), columns);
  std::vector<double> currents_A;
  std::vector<std::vector<double>> half_width_N;
  std::vector<std::vector<double>> mean_N;
  for (const Level& level : levels) {
    const BothDirections both = average_both_directions({level, position_m, deviation_N}, grid_m, samples.file);
    currents_A.push_back(level.value);
    mean_N.push_back(both.mean());
    half_width_N.emplace_back();
    // The magnet pulls open against the load cell: friction takes from the pull while opening, adds to it while
    // closing.
    for (const double opening_less_closing : both.half_width())
      half_width_N.back().push_back(std::max(0.0, -opening_less_closing));
  }
  over_rows(fit.friction_N, currents_A, half_width_N);
  for (double& node_N : fit.friction_N.values) node_N = std::max(0.0, node_N);  // the trend below the first current
  FrictionMap correction = fit.friction_N;
  over_rows(correction, currents_A, mean_N);
  for (int row = 1; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      fit.magnetic_force.map.node(row, column) += correction.node(row, column);

  take_residuals(fit, samples, {levels, position_m, magnetising_A}, stroke_m);
  return fit;
}

LoopWidths part_loop_widths(const MagneticForceFit& map) {
  NormalEquations equations{Eigen::MatrixXd::Zero(3, 3), Eigen::VectorXd::Zero(3)};
  const auto visit = [&](const auto& take) {
    for (const model::MagneticForceLoop& loop : map.loops) {
      for (std::size_t k = 0; k < loop.position_m.size(); ++k) {
        const auto force = map.magnetic_force.at(loop.current_A, loop.position_m[k]);
        take(Eigen::Vector3d(1, force.value, force.row_slope), 0.5 * (loop.closing_N[k] - loop.opening_N[k]));
      }
    }
  };
  visit([&](const Eigen::Vector3d& row, double half_width_N) {
    equations.matrix += row * row.transpose();
    equations.right += half_width_N * row;
  });
  const Eigen::VectorXd solution = solve_nonnegative(equations);
  LoopWidths out{solution(0), solution(1), solution(2), {}, {}};
  std::vector<Eigen::Vector4d> rows;
  visit([&](const Eigen::Vector3d& row, double half_width_N) {
    out.residual.add(half_width_N - row.dot(solution));
    rows.emplace_back(row(0), row(1), row(2), half_width_N);
  });
  out.known = known_from("widths of the force map's loops: armature friction and coercive current",
                         {"constant_friction_N", "friction_per_magnetic_force", "coercive_current_A"},
                         {solution.begin(), solution.end()}, covariance_among_free(stacked(rows), solution));
  return out;
}

}  // namespace spoolflow::calibration
