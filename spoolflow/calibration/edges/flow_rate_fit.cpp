#include "spoolflow/calibration/edges/flow_rate_fit.hpp"

#include <algorithm>
#include <cmath>

#include "spoolflow/calibration/numerics/interpolation.hpp"

namespace spoolflow::calibration {
namespace {

/// Points of one column over the root of the force's share of `largest_N`, rising strictly from the origin.
struct RootPoints {
  std::vector<double> root_share{0.0};
  std::vector<double> flow_m3_per_s{0.0};
  std::vector<double> root_pressure{0.0};
};

RootPoints root_points(const FlowForceColumn& column, const std::vector<double>& force_N, double largest_N) {
  const std::vector<double> flow = non_decreasing(column.flow_m3_per_s);
  constexpr double least_step = 1e-3;  // closer points carry no slope, only noise: the higher level stands for both
  RootPoints points;
  for (std::size_t l = 0; l < force_N.size(); ++l) {
    const double share = std::sqrt(std::clamp(force_N[l] / largest_N, 0.0, 1.0));
    const double root_pressure = std::sqrt(std::max(column.pressure_difference_Pa[l], 0.0));
    if (share < points.root_share.back() + least_step) {
      if (points.root_share.size() > 1) {
        points.flow_m3_per_s.back() = std::max(points.flow_m3_per_s.back(), flow[l]);
        points.root_pressure.back() = std::max(points.root_pressure.back(), root_pressure);
      }
      continue;
    }
    points.root_share.push_back(share);
    points.flow_m3_per_s.push_back(std::max(flow[l], points.flow_m3_per_s.back()));
    points.root_pressure.push_back(std::max(root_pressure, points.root_pressure.back()));
  }
  if (points.root_share.back() < 1.0) {  // no force rose above the least one: what was measured stands at the far edge
    points.root_share.push_back(1.0);
    points.flow_m3_per_s.push_back(std::max(points.flow_m3_per_s.back(), flow.back()));
    points.root_pressure.push_back(
        std::max(points.root_pressure.back(), std::sqrt(std::max(column.pressure_difference_Pa.back(), 0.0))));
  }
  return points;
}

}  // namespace

std::vector<FlowForceColumn> flow_force_columns(const std::vector<model::AxialForceLoop>& loops,
                                                const sensor::Spring<double>& spring) {
  std::vector<FlowForceColumn> columns(loops.front().position_m.size());
  for (std::size_t p = 0; p < columns.size(); ++p) {
    FlowForceColumn& column = columns[p];
    column.position_m = loops.front().position_m[p];
    const double spring_N = spring.at(column.position_m).value;
    for (const model::AxialForceLoop& loop : loops) {
      column.flow_force_N.push_back(0.5 * (loop.opening_N[p] + loop.closing_N[p]) - spring_N);  // paper (1)
      column.flow_m3_per_s.push_back(loop.flow_m3_per_s[p]);
      column.pressure_difference_Pa.push_back(loop.pressure_difference_Pa[p]);
    }
  }
  return columns;
}

sensor::FlowRate<double> invert_flow_force(const std::vector<FlowForceColumn>& columns, double least_force_N) {
  sensor::FlowRate<double> out{};
  const double step_m = (columns.back().position_m - columns.front().position_m) / (sensor::flow_map_positions - 1);
  const sensor::Axis<double> positions{columns.front().position_m, step_m, 1 / step_m};
  const std::vector<double> roots = equally_spaced(0, 1, sensor::flow_map_forces);
  const sensor::Axis<double> root_axis{0, roots[1], 1 / roots[1]};
  out.largest_force_N.axis = positions;
  out.flow_m3_per_s.row_axis = out.root_pressure_difference.row_axis = positions;
  out.flow_m3_per_s.column_axis = out.root_pressure_difference.column_axis = root_axis;
  for (int p = 0; p < sensor::flow_map_positions; ++p) {
    const FlowForceColumn& column = columns[static_cast<std::size_t>(p)];
    const std::vector<double> force_N = non_decreasing(column.flow_force_N);
    const double largest_N = std::max(force_N.back(), least_force_N);
    out.largest_force_N.values[static_cast<std::size_t>(p)] = largest_N;
    const RootPoints points = root_points(column, force_N, largest_N);
    const std::vector<double> flow = interpolate_monotone({points.root_share, points.flow_m3_per_s}, roots);
    const std::vector<double> root_pressure = interpolate_monotone({points.root_share, points.root_pressure}, roots);
    for (int f = 0; f < sensor::flow_map_forces; ++f) {
      out.flow_m3_per_s.node(p, f) = flow[static_cast<std::size_t>(f)];
      out.root_pressure_difference.node(p, f) = root_pressure[static_cast<std::size_t>(f)];
    }
  }
  return out;
}

}  // namespace spoolflow::calibration
