#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "spoolflow/report/calibration/calibration_figures.hpp"
#include "spoolflow/report/figures/heat_scale.hpp"

namespace spoolflow::report {
namespace {

/// In % FS per newton.
constexpr HeatScale sensitivity_heat({0, 0.5, 1, 1.5, 2, 3, 5, 10});

/// Half way to the neighbour before the k-th grid point; the grid's own ends stay.
double edge_before(const std::vector<double>& grid, std::size_t k) {
  if (k == 0) return grid.front();
  if (k == grid.size()) return grid.back();
  return 0.5 * (grid[k - 1] + grid[k]);
}

std::vector<Cell> cells_of(const model::SensitivityMap& map, double full_scale_m3_per_s) {
  std::vector<Cell> cells;
  const std::size_t columns = map.pressure_difference_Pa.size();
  for (std::size_t d = 0; d < columns; ++d) {
    for (std::size_t p = 0; p < map.position_m.size(); ++p) {
      const double slope = 100 * map.flow_per_force_m3_per_s_N[p * columns + d] / full_scale_m3_per_s;
      cells.push_back({edge_before(map.position_m, p), edge_before(map.position_m, p + 1),
                       edge_before(map.pressure_difference_Pa, d), edge_before(map.pressure_difference_Pa, d + 1),
                       sensitivity_heat.colour(slope)});
    }
  }
  return cells;
}

/// Where the runs worked, once each.
Mark operating_dots(const std::vector<validation::RunResult>& runs) {
  std::set<std::pair<double, double>> points;
  for (const validation::RunResult& run : runs) {
    for (const validation::OperatingPoint& point : run.operating_points) {
      points.emplace(point.position_m, point.pressure_difference_Pa);
    }
  }
  Mark dots{
      .shape = Shape::dots, .tone = "ink", .name = points.empty() ? "" : "where the runs worked", .width_px = 1.7};
  for (const auto& [x, y] : points) {
    dots.x.push_back(x);
    dots.y.push_back(y);
  }
  return dots;
}

}  // namespace

CaptionedFigure sensitivity_figure(const model::Model& model, const std::vector<validation::RunResult>& runs) {
  const model::SensitivityMap& map = model.evidence.sensitivity;
  CaptionedFigure out{{
                          .description = "Slope of flow rate over force by position and pressure difference",
                          .x_title = "Position",
                          .x_quantity = units::Kind::length,
                          .x_lowest = 0.0,
                          .x_highest = model.valve.stroke_m,
                      },
                      {},
                      sensitivity_heat.legend("% FS per newton")};
  Panel panel{.title = "Pressure difference", .quantity = units::Kind::pressure, .height_px = 330, .lowest = 0.0};
  if (!map.position_m.empty() && !map.pressure_difference_Pa.empty()) {
    panel.cells = cells_of(map, model.valve.rated_flow_m3_per_s);
    panel.highest = map.pressure_difference_Pa.back();
    Mark dots = operating_dots(runs);
    if (!dots.x.empty()) {
      panel.highest = std::max(*panel.highest, *std::ranges::max_element(dots.y));
      out.legend.insert(
          out.legend.rfind("</div>"),
          R"(<span><svg viewBox="0 0 16 12" aria-hidden="true"><path class="dots ink" stroke-width="3" d="M8 6h0"/></svg>where the runs worked</span>)");
    }
    panel.marks.push_back(std::move(dots));
  }
  out.figure.panels.push_back(std::move(panel));
  out.caption =
      "What one newton of force error costs, in percent of full scale: the largest slope dQ/dF of the flow-force map "
      "at "
      "each point. Low pressure differences are blind because the flow force grows with the pressure difference, and "
      "so "
      "with the square of the flow; small openings because they let hardly any flow act on the spool.";
  return out;
}

}  // namespace spoolflow::report
