#include "spoolflow/calibration/edges/metering_edge_fit.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/calibration/fits/bench_strokes.hpp"
#include "spoolflow/calibration/numerics/fitted_parameters.hpp"
#include "spoolflow/calibration/numerics/interpolation.hpp"
#include "spoolflow/calibration/numerics/linear_least_squares.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::calibration {
namespace {

/// One position at one temperature, over the sensor's pressure differences.
struct EdgeColumn {
  std::vector<double> flow_force_N;
  std::vector<double> friction_N;
  std::vector<double> conductance;
};

EdgeColumn column_at(const AxialForceFit& fit, std::size_t position, double spring_N, double unloaded_friction_N,
                     const std::vector<double>& pressures_Pa) {
  EdgeLevels known = levels_at(fit, position, spring_N);
  known.friction_N.front() = unloaded_friction_N;
  // The supply holds the highest level a little below what it was set to: the trend goes on to there.
  std::vector<double>& known_Pa = known.pressure_Pa;
  const std::size_t last = known_Pa.size() - 1;
  const double beyond_Pa = 0.05 * known_Pa[last];
  const auto go_on = [&](std::vector<double>& values) {
    const double slope = (values[last] - values[last - 1]) / (known_Pa[last] - known_Pa[last - 1]);
    values.push_back(values[last] + slope * beyond_Pa);
  };
  go_on(known.force_N);
  go_on(known.friction_N);
  known.conductance.push_back(known.conductance[last]);
  known_Pa.push_back(known_Pa[last] + beyond_Pa);
  EdgeColumn out{interpolate_monotone({known_Pa, known.force_N}, pressures_Pa),
                 interpolate_monotone({known_Pa, known.friction_N}, pressures_Pa),
                 interpolate_monotone({known_Pa, known.conductance}, pressures_Pa)};
  for (double& each : out.friction_N) each = std::max(0.0, each);  // rounding, and the trend beyond the highest level
  return out;
}

/// The maps where the valve is three quarters open: flow force over pressure, friction over pressure, conductance, each
/// with its slope over temperature where there are several.
std::vector<model::Fit> laws_of(const std::vector<const AxialForceFit*>& fits, const sensor::Spring<double>& spring) {
  const std::vector<double>& grid_m = fits.front()->loops.front().position_m;
  const std::size_t at = 3 * grid_m.size() / 4;
  double middle_K = 0;
  for (const AxialForceFit* fit : fits) middle_K += fit->oil_temperature_K / static_cast<double>(fits.size());
  std::vector<Eigen::Vector3d> force, friction, conductance;  // pressure, warmth, what is measured
  for (const AxialForceFit* fit : fits) {
    for (const model::AxialForceLoop& loop : fit->loops) {
      const double pressure_Pa = loop.pressure_difference_Pa[at];
      if (!(pressure_Pa > 0)) continue;
      const double warmth_K = fit->oil_temperature_K - middle_K;
      force.emplace_back(pressure_Pa, pressure_Pa * warmth_K,
                         0.5 * (loop.opening_N[at] + loop.closing_N[at]) - spring.at(grid_m[at]).value);
      friction.emplace_back(pressure_Pa, warmth_K, 0.5 * std::abs(loop.opening_N[at] - loop.closing_N[at]));
      conductance.emplace_back(1, warmth_K, loop.flow_m3_per_s[at] / std::sqrt(pressure_Pa));
    }
  }
  const bool several = fits.size() > 1;
  const std::string where =
      fmt::format("at {:.2f} mm and {:.0f} \u00b0C", units::mm_from_m(grid_m[at]), units::degC_from_K(middle_K));
  std::vector<model::Fit> out;
  const auto add = [&](const std::string& of, const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right,
                       std::vector<std::string> names) {
    const Eigen::Index unknowns = matrix.cols() - (several ? 0 : 1);  // the slope over temperature stands last
    names.resize(static_cast<std::size_t>(unknowns));
    if (matrix.rows() <= unknowns) return;
    out.push_back(
        known_from_apart(of + " " + where, names, least_squares(matrix.leftCols(unknowns), right, of.c_str())));
  };
  const Eigen::MatrixXd force_rows = stacked(force), conductance_rows = stacked(conductance);
  Eigen::MatrixXd friction_rows(force_rows.rows(), 4);
  friction_rows << Eigen::VectorXd::Ones(force_rows.rows()), stacked(friction);
  add("flow force", force_rows.leftCols(2), force_rows.col(2),
      {"flow_force_per_pressure_N_per_Pa", "flow_force_per_pressure_and_temperature_N_per_Pa_K"});
  add("spool friction", friction_rows.leftCols(3), friction_rows.col(3),
      {"friction_without_pressure_N", "friction_per_pressure_N_per_Pa", "friction_per_temperature_N_per_K"});
  add("conductance, flow rate over the root of the pressure difference,", conductance_rows.leftCols(2),
      conductance_rows.col(2), {"conductance_m3_per_s_rootPa", "conductance_per_temperature_m3_per_s_rootPa_K"});
  return out;
}

}  // namespace

EdgeLevels levels_at(const AxialForceFit& fit, std::size_t position, double spring_N) {
  EdgeLevels out{{0}, {0}, {0}, {0}};
  for (const model::AxialForceLoop& loop : fit.loops) {
    const double pressure_Pa = loop.pressure_difference_Pa[position];
    if (!(pressure_Pa > out.pressure_Pa.back())) continue;  // a level that the supply could not hold adds nothing
    out.pressure_Pa.push_back(pressure_Pa);
    out.force_N.push_back(0.5 * (loop.opening_N[position] + loop.closing_N[position]) - spring_N);
    out.friction_N.push_back(0.5 * std::abs(loop.opening_N[position] - loop.closing_N[position]));
    out.conductance.push_back(std::max(loop.flow_m3_per_s[position], 0.0) / std::sqrt(pressure_Pa));
  }
  if (out.conductance.size() > 1) out.conductance.front() = out.conductance[1];
  out.force_N = non_decreasing(out.force_N);
  return out;
}

MeteringEdgeFit fit_metering_edge(std::vector<AxialForceFit> fits, const sensor::Spring<double>& spring,
                                  const std::vector<double>& unloaded_friction_N) {
  constexpr double assumed_K = 323.15;  // a campaign without temperatures: the maps do not depend on it anyway
  for (AxialForceFit& fit : fits) {
    if (std::isnan(fit.oil_temperature_K)) fit.oil_temperature_K = assumed_K;
  }
  std::sort(fits.begin(), fits.end(),
            [](const AxialForceFit& a, const AxialForceFit& b) { return a.oil_temperature_K < b.oil_temperature_K; });
  std::vector<const AxialForceFit*> used;
  std::vector<double> known_K;
  for (const AxialForceFit& fit : fits) {
    if (!known_K.empty() && fit.oil_temperature_K < known_K.back() + same_oil_temperature_K) continue;
    known_K.push_back(fit.oil_temperature_K);
    used.push_back(&fit);
  }
  double highest_Pa = 0;
  for (const AxialForceFit* fit : used) highest_Pa = std::max(highest_Pa, fit->loops.back().pressure_difference_set_Pa);

  MeteringEdgeFit out{};
  out.lowest_temperature_K = known_K.front();
  out.highest_temperature_K = known_K.back();
  out.known = laws_of(used, spring);
  sensor::MeteringEdge<double>& edge = out.edge;
  const double width_K = known_K.size() > 1 ? known_K.back() - known_K.front() : 2 * about_one_temperature_K;
  const double first_K = known_K.size() > 1 ? known_K.front() : known_K.front() - about_one_temperature_K;
  const double step_K = width_K / (sensor::edge_temperatures - 1);
  const double step_Pa = highest_Pa / (sensor::edge_pressures - 1);
  const std::vector<double>& grid_m = used.front()->loops.front().position_m;
  edge.temperature_K = {first_K, step_K, 1 / step_K};
  edge.pressure_difference_Pa = {0, step_Pa, 1 / step_Pa};
  edge.position_m = {grid_m[0], grid_m[1] - grid_m[0], 1 / (grid_m[1] - grid_m[0])};
  const std::vector<double> pressures_Pa = equally_spaced(0, highest_Pa, sensor::edge_pressures);
  for (int column = 0; column < sensor::edge_positions; ++column) {
    const auto p = static_cast<std::size_t>(column);
    const auto unloaded = static_cast<std::size_t>(
        std::lround(static_cast<double>(column) * static_cast<double>(unloaded_friction_N.size() - 1) /
                    (sensor::edge_positions - 1)));
    std::vector<EdgeColumn> columns;
    for (const AxialForceFit* fit : used) {
      columns.push_back(
          column_at(*fit, p, spring.at(grid_m[p]).value, std::abs(unloaded_friction_N[unloaded]), pressures_Pa));
    }
    for (int row = 0; row < sensor::edge_pressures; ++row) {
      const auto r = static_cast<std::size_t>(row);
      for (int layer = 0; layer < sensor::edge_temperatures; ++layer) {
        const auto over_temperature = [&](auto member) {
          std::vector<double> values;
          for (const EdgeColumn& each : columns) values.push_back((each.*member)[r]);
          return interpolate_monotone({known_K, values}, std::vector<double>{edge.temperature_K.at(layer)}).front();
        };
        edge.flow_force_N.node(layer, row, column) = over_temperature(&EdgeColumn::flow_force_N);
        edge.friction_N.node(layer, row, column) = over_temperature(&EdgeColumn::friction_N);
        edge.conductance.node(layer, row, column) = over_temperature(&EdgeColumn::conductance);
      }
    }
  }
  return out;
}

std::vector<std::string> maps_left_aside(const std::vector<const recording::Recording*>& maps) {
  std::vector<std::string> out;
  for (std::size_t k = 1; k < maps.size(); ++k) {
    const double its_K = mean_oil_temperature_K(*maps[k]);
    const auto same = std::find_if(maps.begin(), maps.begin() + static_cast<std::ptrdiff_t>(k), [&](const auto* other) {
      return !(std::abs(mean_oil_temperature_K(*other) - its_K) >= same_oil_temperature_K);
    });
    if (*same == maps[k]) continue;
    const std::string both =
        fmt::format("{} and {}", (*same)->file.filename().string(), maps[k]->file.filename().string());
    const bool known = std::isfinite(its_K + mean_oil_temperature_K(**same));
    out.push_back(
        known ? fmt::format("{} are both of oil at {:.1f} degC, and one of them is left aside; name one "
                            "recording an oil temperature, with all its pressure differences",
                            both, units::degC_from_K(its_K))
              : fmt::format("{}: no oil temperature distinguishes them, one of them is left aside, and the band "
                            "holds at one unknown oil temperature alone; record oil_temperature, or name its "
                            "column in a channel map",
                            both));
  }
  return out;
}

}  // namespace spoolflow::calibration
