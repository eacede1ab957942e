#include "spoolflow/calibration/fits/map_residuals.hpp"

#include <algorithm>
#include <cmath>

#include "spoolflow/calibration/fits/axial_force.hpp"
#include "spoolflow/calibration/fits/bench_strokes.hpp"

namespace spoolflow::calibration {

void ResidualProfile::add(double position_m, double deviation_N) {
  if (std::isnan(position_m) || std::isnan(deviation_N)) return;
  const double place = std::clamp(position_m / stroke_m_, 0.0, 1.0) * static_cast<double>(bins);
  const std::size_t bin = std::min(bins - 1, static_cast<std::size_t>(place));
  bins_[bin].add(deviation_N);
  sums_[bin] += deviation_N;
}

model::MapResidual ResidualProfile::at(double held, double oil_temperature_K) const {
  const auto rounded = [](double force_N) { return std::round(1e3 * force_N) / 1e3; };
  model::MapResidual out{held, oil_temperature_K, {}, {}, {}};
  for (std::size_t bin = 0; bin < bins; ++bin) {
    if (bins_[bin].samples == 0) continue;
    out.position_m.push_back(stroke_m_ * (static_cast<double>(bin) + 0.5) / static_cast<double>(bins));
    out.mean_N.push_back(rounded(sums_[bin] / static_cast<double>(bins_[bin].samples)));
    out.rms_N.push_back(rounded(bins_[bin].rms()));
  }
  return out;
}

std::vector<model::MapResidual> axial_force_residuals(const recording::Recording& recording,
                                                      const sensor::Spring<double>& spring,
                                                      const sensor::MeteringEdge<double>& edge, double stroke_m) {
  constexpr double without_temperature_K = 323.15;  // the maps do not depend on it then
  const auto position_m = recording[recording::Channel::position];
  const auto force_N = recording[recording::Channel::axial_force];
  const double recorded_K = mean_oil_temperature_K(recording);
  const double temperature_K = std::isnan(recorded_K) ? without_temperature_K : recorded_K;
  const HeldPressures held = find_held_pressures(recording, stroke_m);
  std::vector<model::MapResidual> out;
  for (const Level& level : held.levels) {
    ResidualProfile profile(stroke_m);
    for (const Sweep& sweep : level.sweeps) {
      const double sign = sweep.direction == Direction::opening ? 1 : -1;
      for (std::size_t k = sweep.begin; k < sweep.end; ++k) {
        const double pressure_Pa = std::max(0.0, held.pressure_difference_Pa[k]);
        const auto point = edge.at(temperature_K, pressure_Pa, position_m[k]);
        profile.add(position_m[k],
                    force_N[k] - spring.at(position_m[k]).value - point.flow_force_N - sign * point.friction_N);
      }
    }
    out.push_back(profile.at(level.value, std::isnan(recorded_K) ? 0 : recorded_K));
  }
  return out;
}

}  // namespace spoolflow::calibration
