#include "spoolflow/calibration/condensed.hpp"

#include <algorithm>
#include <cmath>

#include "spoolflow/calibration/edges/flow_rate_fit.hpp"
#include "spoolflow/calibration/edges/uniqueness.hpp"
#include "spoolflow/calibration/fits/magnetic_force_fit.hpp"
#include "spoolflow/calibration/fits/spring_fit.hpp"
#include "spoolflow/model/residual_of.hpp"

namespace spoolflow::calibration {
namespace {

/// The flow-force map at the middle of the oil temperatures; recordings without temperature sort first.
AxialForceFit middle_temperature(std::vector<AxialForceFit> fits) {
  std::sort(fits.begin(), fits.end(), [](const AxialForceFit& a, const AxialForceFit& b) {
    return std::isnan(a.oil_temperature_K) ? !std::isnan(b.oil_temperature_K)
                                           : a.oil_temperature_K < b.oil_temperature_K;
  });
  return fits[(fits.size() - 1) / 2];
}

/// Half the distance of both directions, largest over the levels: what friction may hide at each position.
sensor::Curve<double, sensor::spring_positions> friction_bound(const std::vector<model::AxialForceLoop>& loops,
                                                               const SpringFit& spring) {
  sensor::Curve<double, sensor::spring_positions> bound{spring.spring.curve.axis, {}};
  for (int k = 0; k < sensor::spring_positions; ++k) {
    double& width_N = bound.values[static_cast<std::size_t>(k)];
    width_N = std::abs(spring.friction_half_width_N[static_cast<std::size_t>(k)]);
    for (const model::AxialForceLoop& loop : loops) {
      const std::size_t p = static_cast<std::size_t>(std::lround(
          static_cast<double>(k) * static_cast<double>(loop.position_m.size() - 1) / (sensor::spring_positions - 1)));
      width_N = std::max(width_N, 0.5 * std::abs(loop.opening_N[p] - loop.closing_N[p]));
    }
  }
  return bound;
}

/// Positions from the closed end at which even the highest pressure difference gave no flow above its noise.
double closed_below_m(const model::AxialForceLoop& highest, double rated_flow_m3_per_s, double flow_noise_m3_per_s) {
  const double threshold = std::max(0.002 * rated_flow_m3_per_s, 0.5 * flow_noise_m3_per_s);
  std::size_t k = 0;
  while (k + 1 < highest.position_m.size() && highest.flow_m3_per_s[k] < threshold) ++k;
  return k == 0 ? highest.position_m.front() : highest.position_m[k - 1];
}

}  // namespace

CondensedCalibration calibrate_condensed(const CampaignRecordings& recordings, const model::Valve& valve) {
  const SpringFit spring = fit_spring(recordings.spring, valve.stroke_m);
  const MagneticForceFit magnetic = fit_magnetic_force(recordings.solenoid_force_map, valve.stroke_m);
  const AxialForceMaps& maps = recordings.axial_force_maps;
  const AxialForceFit axial = middle_temperature(fit_path(maps, spring.spring, valve.stroke_m).path);
  const std::vector<FlowForceColumn> columns = flow_force_columns(axial.loops, spring.spring);

  // An averaged force is the mean of some dozen samples a grid point and direction; a fifth of the sample noise bounds
  // it.
  const double averaged_force_noise_N = 0.2 * std::hypot(axial.force_residual.rms(), spring.residual.rms());

  CondensedCalibration out{};
  sensor::CondensedParameters<double>& parameters = out.condensed.parameters;
  parameters.magnetic_force = magnetic.magnetic_force;
  parameters.spring = spring.spring;
  parameters.flow_rate = invert_flow_force(columns, 2 * averaged_force_noise_N + 1e-6);
  parameters.friction_half_width_N = friction_bound(axial.loops, spring);
  parameters.closed_below_m = closed_below_m(axial.loops.back(), valve.rated_flow_m3_per_s, axial.flow_residual.rms());
  parameters.force_residual_N = std::hypot(magnetic.residual.rms(), axial.force_residual.rms(), spring.residual.rms());
  parameters.flow_residual_m3_per_s =
      flow_residual_with_unknown_edges(maps, axial.flow_residual.rms(), valve.rated_flow_m3_per_s);

  if (recordings.flow_bench != nullptr) {
    parameters.force_residual_N = std::max(parameters.force_residual_N, recordings.flow_bench->force_residual_N);
    parameters.flow_residual_m3_per_s =
        std::max(parameters.flow_residual_m3_per_s, recordings.flow_bench->flow_residual_m3_per_s);
  }

  out.condensed.current_A = {0, magnetic.largest_current_A};
  out.condensed.position_m = {0, valve.stroke_m};
  out.condensed.pressure_difference_Pa = {axial.loops.front().pressure_difference_set_Pa,
                                          axial.loops.back().pressure_difference_set_Pa};
  if (!std::isnan(axial.oil_temperature_K)) out.condensed.oil_temperature_K = axial.oil_temperature_K;
  out.condensed.residuals = {
      {std::string(model::of_spring_force), "N", spring.residual.rms(), spring.residual.largest},
      {"spring force, with one friction for all positions", "N", spring.even_friction_residual.rms(),
       spring.even_friction_residual.largest},
      {std::string(model::of_magnetic_force), "N", magnetic.residual.rms(), magnetic.residual.largest},
      {std::string(model::of_axial_force), "N", axial.force_residual.rms(), axial.force_residual.largest},
      {std::string(model::of_flow_rate), "m3/s", axial.flow_residual.rms(), axial.flow_residual.largest},
  };
  if (recordings.flow_bench != nullptr) widen(out.condensed.residuals, *recordings.flow_bench);
  out.evidence.magnetic_force = magnetic.loops;
  out.evidence.axial_force = axial.loops;
  out.evidence.sensitivity = flow_sensitivity(columns, valve.rated_flow_m3_per_s);
  out.evidence.uniqueness = check_uniqueness(columns, 2 * parameters.force_residual_N);
  return out;
}

}  // namespace spoolflow::calibration
