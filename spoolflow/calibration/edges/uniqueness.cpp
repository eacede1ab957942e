#include "spoolflow/calibration/edges/uniqueness.hpp"

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

}  // namespace spoolflow::calibration
