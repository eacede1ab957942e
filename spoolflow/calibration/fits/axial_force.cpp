#include "spoolflow/calibration/fits/axial_force.hpp"

#include <fmt/format.h>

#include "spoolflow/calibration/fits/bench_strokes.hpp"
#include "spoolflow/calibration/fits/both_directions.hpp"
#include "spoolflow/calibration/numerics/calibration_error.hpp"
#include "spoolflow/calibration/numerics/interpolation.hpp"
#include "spoolflow/sensor/flow_rate.hpp"

namespace spoolflow::calibration {
namespace {

using recording::Channel;
constexpr std::size_t least_pressures = 3;

std::vector<double> measured_pressure_difference_Pa(const recording::Recording& recording) {
  if (recording.has(Channel::pressure_difference)) {
    const auto given = recording[Channel::pressure_difference];
    return {given.begin(), given.end()};
  }
  const auto upstream = recording[Channel::pressure_upstream];
  const auto downstream = recording[Channel::pressure_downstream];
  std::vector<double> difference(upstream.size());
  for (std::size_t k = 0; k < difference.size(); ++k) difference[k] = upstream[k] - downstream[k];
  return difference;
}

const HeldQuantity held_quantity{"pressure difference", "bar", 1e-5};

}  // namespace

HeldPressures find_held_pressures(const recording::Recording& recording, double stroke_m) {
  HeldPressures out{measured_pressure_difference_Pa(recording), {}};
  const auto held = recording.has(Channel::pressure_difference_set)
                        ? recording[Channel::pressure_difference_set]
                        : std::span<const double>(out.pressure_difference_Pa);
  out.levels = sort_by_level(find_bench_strokes(recording[Channel::position], stroke_m), held);
  require_levels(out.levels, least_pressures, held_quantity, recording.file.filename().string());
  return out;
}

AxialForceFit fit_axial_force(const recording::Recording& recording, double stroke_m) {
  const std::string file = recording.file.filename().string();
  const auto position_m = recording[Channel::position];
  const auto force_N = recording[Channel::axial_force];
  const auto flow_m3_per_s = recording[recording.has(Channel::flow) ? Channel::flow : Channel::flow_reference];
  const auto [pressure_Pa, levels] = find_held_pressures(recording, stroke_m);

  AxialForceFit fit{};
  fit.oil_temperature_K = mean_oil_temperature_K(recording);
  const std::vector<double> grid_m = equally_spaced(0, stroke_m, sensor::flow_map_positions);
  const sensor::Axis<double> axis{0, grid_m[1], 1 / grid_m[1]};
  for (const Level& level : levels) {
    const std::string what = fmt::format("{}: {} {}", file, held_quantity.name, held_quantity.written(level.value));
    const BothDirections force = without_breakaway(average_both_directions({level, position_m, force_N}, grid_m, what),
                                                   wearing_stroke_share * stroke_m);
    const BothDirections flow = average_both_directions({level, position_m, flow_m3_per_s}, grid_m, what);
    const BothDirections pressure = average_both_directions({level, position_m, pressure_Pa}, grid_m, what);
    fit.loops.push_back({level.value, grid_m, force.opening, force.closing, flow.mean(), pressure.mean()});

    for (const Sweep& sweep : level.sweeps) {
      const bool opening = sweep.direction == Direction::opening;
      const auto curve = [&](const std::vector<double>& values) {
        sensor::Curve<double, sensor::flow_map_positions> out{axis, {}};
        for (std::size_t k = 0; k < values.size(); ++k) out.values[k] = values[k];
        return out;
      };
      const auto force_curve = curve(opening ? force.opening : force.closing);
      const auto flow_curve = curve(opening ? flow.opening : flow.closing);
      for (std::size_t k = sliding_part(sweep, position_m, stroke_m).begin; k < sweep.end; ++k)
        fit.force_residual.add(force_N[k] - force_curve.at(position_m[k]).value);
      for (std::size_t k = sweep.begin; k < sweep.end; ++k)
        fit.flow_residual.add(flow_m3_per_s[k] - flow_curve.at(position_m[k]).value);
    }
  }
  return fit;
}

}  // namespace spoolflow::calibration
