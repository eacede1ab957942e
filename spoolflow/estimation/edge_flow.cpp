#include "spoolflow/estimation/edge_flow.hpp"

#include <cmath>
#include <limits>

namespace spoolflow::estimation {

std::vector<double> edge_flow(const PassedEdges& edges, std::span<const double> position_m,
                              std::span<const double> pressure_difference_Pa,
                              std::span<const double> oil_temperature_K) {
  double temperature_K = edges.open->edge.temperature_K.at(sensor::edge_temperatures / 2);
  std::vector<double> out(position_m.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t k = 0; k < out.size(); ++k) {
    if (!oil_temperature_K.empty() && std::isfinite(oil_temperature_K[k])) temperature_K = oil_temperature_K[k];
    const double opening_m = sensor::drift_free_m(edges.open->position_sensor, position_m[k], temperature_K);
    const double drop_Pa = std::abs(pressure_difference_Pa[k]);
    if (!std::isfinite(opening_m + drop_Pa)) continue;
    const bool to_a = edges.open_to_a != nullptr && opening_m < 0;
    const double sign = to_a ? -1 : 1;
    out[k] = sign *
             (to_a ? edges.open_to_a : edges.open)->edge.at(temperature_K, drop_Pa, sign * opening_m).conductance *
             std::sqrt(drop_Pa);
  }
  return out;
}

}  // namespace spoolflow::estimation
