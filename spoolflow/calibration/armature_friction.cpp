#include "spoolflow/calibration/armature_friction.hpp"

#include <cmath>

#include "spoolflow/calibration/interpolation.hpp"

namespace spoolflow::calibration {

sensor::Map<double, sensor::force_map_currents, sensor::force_map_positions> armature_friction(
    const MagneticForceFit& fit) {
  sensor::Map<double, sensor::force_map_currents, sensor::force_map_positions> out{
      fit.magnetic_force.map.row_axis, fit.magnetic_force.map.column_axis, {}};
  std::vector<double> currents_A;
  for (const model::MagneticForceLoop& loop : fit.loops) currents_A.push_back(loop.current_A);
  const std::vector<double> rows_A = equally_spaced(0, fit.largest_current_A, sensor::force_map_currents);
  for (int column = 0; column < sensor::force_map_positions; ++column) {
    std::vector<double> half_width_N;
    for (const model::MagneticForceLoop& loop : fit.loops) {
      const auto c = static_cast<std::size_t>(column);
      half_width_N.push_back(0.5 * std::abs(loop.closing_N[c] - loop.opening_N[c]));
    }
    const std::vector<double> values = interpolate_monotone({currents_A, half_width_N}, rows_A);
    for (int row = 0; row < sensor::force_map_currents; ++row)
      out.node(row, column) = values[static_cast<std::size_t>(row)];
  }
  return out;
}

}  // namespace spoolflow::calibration
