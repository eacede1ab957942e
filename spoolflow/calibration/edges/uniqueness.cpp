#include "spoolflow/calibration/edges/uniqueness.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "spoolflow/calibration/numerics/interpolation.hpp"

namespace spoolflow::calibration {

model::Uniqueness check_uniqueness(const std::vector<FlowForceColumn>& columns, double force_noise_N) {
  const double beyond_the_map_m = columns.back().position_m;
  model::Uniqueness out{beyond_the_map_m, beyond_the_map_m, {}};
  bool unique = true;
  bool seen = true;
  for (auto column = columns.rbegin(); column != columns.rend(); ++column) {
    const std::vector<double>& force_N = column->flow_force_N;
    bool rises = true;
    for (std::size_t l = 0; l + 1 < force_N.size(); ++l) {
      const double rise_N = force_N[l + 1] - force_N[l];
      rises = rises && rise_N > 0;
      if (rise_N < -force_noise_N) {
        out.ambiguous_at_m.insert(out.ambiguous_at_m.begin(), column->position_m);
        break;
      }
    }
    unique = unique && rises;
    if (unique) out.unique_from_m = column->position_m;
    seen = seen && force_N.back() - force_N.front() > force_noise_N;
    if (seen) out.blind_below_m = column->position_m;
  }
  return out;
}

model::SensitivityMap flow_sensitivity(const std::vector<FlowForceColumn>& columns, double cap_m3_per_s_N) {
  constexpr int pressures = 15;
  double lowest_Pa = 0;
  double highest_Pa = 1e12;
  for (const FlowForceColumn& column : columns) {
    lowest_Pa = std::max(lowest_Pa, column.pressure_difference_Pa.front());
    highest_Pa = std::min(highest_Pa, column.pressure_difference_Pa.back());
  }
  model::SensitivityMap out;
  out.pressure_difference_Pa = equally_spaced(lowest_Pa, highest_Pa, pressures);
  for (const FlowForceColumn& column : columns) {
    out.position_m.push_back(column.position_m);
    const std::vector<double> force_N = non_decreasing(column.flow_force_N);
    for (const double pressure_Pa : out.pressure_difference_Pa) {
      const std::array<double, 2> ends_Pa{std::max(lowest_Pa, pressure_Pa * 0.975),
                                          std::min(highest_Pa, pressure_Pa * 1.025)};
      const std::vector<double> force = interpolate_monotone({column.pressure_difference_Pa, force_N}, ends_Pa);
      const std::vector<double> flow =
          interpolate_monotone({column.pressure_difference_Pa, column.flow_m3_per_s}, ends_Pa);
      const double slope = (flow[1] - flow[0]) / (force[1] - force[0]);
      out.flow_per_force_m3_per_s_N.push_back(std::isfinite(slope) ? std::clamp(slope, 0.0, cap_m3_per_s_N)
                                                                   : cap_m3_per_s_N);
    }
  }
  return out;
}

}  // namespace spoolflow::calibration
