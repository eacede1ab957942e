#include "spoolflow/calibration/fits/actuator_fit.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "spoolflow/calibration/fits/hysteresis_loops.hpp"
#include "spoolflow/calibration/numerics/nonnegative_least_squares.hpp"
#include "spoolflow/model/describe_observer.hpp"

namespace spoolflow::calibration {

void fit_uncertainty(sensor::ActuatorParameters<double>& actuator, const SolenoidSamples& samples) {
  std::map<int, double> count;
  for (const int test : samples.test) count[test] += 1;
  NormalEquations equations{Eigen::MatrixXd::Zero(3, 3), Eigen::VectorXd::Zero(3)};
  sensor::ActuatorState<double> state;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const auto estimate = sensor::step(actuator, state, samples.samples[k], samples.restarts[k] != 0);
    const double slope = estimate.force_per_current_N_per_A;
    const double eddy_A = samples.samples[k].current_A - state.coil.static_current_A;
    const double deviation_N = estimate.magnetic_force_N - samples.force_N[k];
    // Deviations beyond this come from steps that the recorder's samples do not resolve.
    const double resolved_N = 0.05 * std::abs(samples.force_N[k]) + slope * actuator.coercive_current_A;
    if (std::abs(deviation_N) > resolved_N + 3 * actuator.force_uncertainty_N) continue;
    const Eigen::Vector3d row(1, slope * slope, slope * slope * eddy_A * eddy_A);
    const double weight = 1 / count[samples.test[k]];
    equations.matrix += weight * row * row.transpose();
    equations.right += weight * deviation_N * deviation_N * row;
  }
  const Eigen::VectorXd parts = solve_nonnegative(equations);
  actuator.force_uncertainty_N = std::hypot(actuator.force_uncertainty_N, std::sqrt(parts(0)));
  actuator.current_uncertainty_A = std::sqrt(parts(1));
  actuator.eddy_uncertainty = std::min(std::sqrt(parts(2)), model::largest_eddy_uncertainty);
}

namespace {

double largest_flux(const sensor::FluxLinkage<double>& flux_linkage) {
  return flux_linkage.map.node(sensor::flux_map_currents - 1 - sensor::flux_map_currents_below_zero,
                               sensor::flux_map_positions - 1);
}

/// Flux and current of the held loops, both known without the coil's model, as a first guess for the fit.
HysteresisHistory history_of(const FluxEvidence& evidence, const SolenoidSamples& samples, std::size_t begin,
                             std::size_t end, const sensor::FluxLinkage<double>& flux_linkage,
                             const sensor::MagneticForce<double>& magnetic_force, double rate_V) {
  constexpr double slow_s = 0.004;  // samples are averaged to this: fast enough for loops, slow enough for the noise
  HysteresisHistory out;
  out.companions.resize(2);
  const double largest_A = magnetic_force.map.row_axis.at(sensor::force_map_currents - 1);
  double flux_before = 0;
  for (std::size_t k = begin; k < end;) {
    double time_s = 0, current_A = 0, lowest_A = 1e9, highest_A = -1e9, magnetising_A = 0, count = 0;
    bool known = true;
    for (; k < end && time_s < slow_s; ++k) {
      const double here_A = samples.samples[k].current_A;
      time_s += std::max(samples.samples[k].time_step_s, 1e-5);
      current_A += here_A;
      lowest_A = std::min(lowest_A, here_A);
      highest_A = std::max(highest_A, here_A);
      known = known && !std::isnan(evidence.magnetising_current_A[k]);
      magnetising_A += known ? evidence.magnetising_current_A[k] : 0;
      count += 1;
    }
    current_A /= count;
    magnetising_A = known ? magnetising_A / count : std::max(0.0, current_A);
    const double position_m = samples.samples[k - 1].position_m;
    const double flux = flux_linkage.map.at(magnetising_A, position_m).value;
    const double rate = (flux - flux_before) / time_s;
    flux_before = flux;
    const bool resolved = known && highest_A - lowest_A < 0.03 * largest_A;
    out.flux.push_back(flux);
    out.output.push_back(current_A - magnetising_A);
    out.weight.push_back(resolved ? magnetic_force.at(magnetising_A, position_m).row_slope : 0.0);
    out.companions[0].push_back(rate);
    out.companions[1].push_back(rate / std::sqrt(std::abs(rate) + rate_V));
  }
  return out;
}

sensor::Coil<double> first_guess(const FluxEvidence& evidence, const SolenoidSamples& samples,
                                 sensor::Coil<double> coil, const sensor::MagneticForce<double>& magnetic_force) {
  std::vector<HysteresisHistory> histories;
  for (std::size_t begin = 0; begin < samples.size();) {
    std::size_t end = begin + 1;
    while (end < samples.size() && samples.restarts[end] == 0) ++end;
    histories.push_back(history_of(evidence, samples, begin, end, coil.flux_linkage, magnetic_force,
                                   coil.eddy_currents.smallest_rate_V));
    begin = end;
  }
  const HysteresisFit fit = fit_hysteresis(histories);
  coil.hysteresis = fit.hysteresis;
  coil.eddy_currents.classical_A_per_V = fit.companion_shares[0];
  coil.eddy_currents.excess_A_per_rootV = fit.companion_shares[1];
  return coil;
}

}  // namespace

sensor::MagneticHysteresis<double> default_hysteresis(double coercive_current_A, double full_flux_Wb) {
  sensor::MagneticHysteresis<double> out;
  out.per_full_flux = 1 / full_flux_Wb;
  for (int k = 0; k < sensor::hysteresis_elements; ++k) {
    const auto e = static_cast<std::size_t>(k);
    out.threshold[e] =
        full_flux_Wb * 0.001 * std::pow(100.0, static_cast<double>(k) / (sensor::hysteresis_elements - 1));
    out.stiffness[e] = coercive_current_A / sensor::hysteresis_elements / out.threshold[e];
  }
  return out;
}

double smallest_rate_V(const FluxLinkageFit& flux_linkage, double largest_current_A) {
  const double resistance_Ohm = flux_linkage.measured ? flux_linkage.coil_resistance.resistance_Ohm : 10.0;
  return 1e-3 * resistance_Ohm * largest_current_A;
}

ActuatorFit fit_actuator(const ActuatorRecordings& recordings, const MagneticForceFit& map, double stroke_m) {
  ActuatorFit fit{};
  const sensor::MagneticForce<double>& averaged = map.magnetic_force;
  const SolenoidSamples strokes = solenoid_samples(recordings.force_map, stroke_m, Sampling::mean);
  SolenoidSamples dynamic;
  std::vector<FluxEvidence> evidence{evidence_from_current(strokes)};
  fit.flux_linkage = fit_flux_linkage(evidence, averaged);
  if (recordings.dynamic != nullptr) {
    // Whether the recorder took means or instants shows in how well voltage and force agree on the flux.
    bool first = true;
    for (const Sampling sampling : {Sampling::mean, Sampling::instant}) {
      SolenoidSamples candidate = solenoid_samples(*recordings.dynamic, stroke_m, sampling);
      evidence.resize(1);
      evidence.push_back(evidence_from_force(candidate, averaged));
      const FluxLinkageFit flux_linkage = fit_flux_linkage(evidence, averaged);
      if (first || flux_linkage.misfit < fit.flux_linkage.misfit) {
        fit.flux_linkage = flux_linkage;
        dynamic = std::move(candidate);
      }
      first = false;
    }
    evidence.resize(1);
    evidence.push_back(evidence_from_force(dynamic, averaged));
  }

  sensor::Coil<double> coil;
  coil.flux_linkage = fit.flux_linkage.flux_linkage;
  coil.eddy_currents.smallest_rate_V = smallest_rate_V(fit.flux_linkage, map.largest_current_A);
  const double full_flux_Wb = largest_flux(coil.flux_linkage);
  if (recordings.dynamic != nullptr) {
    coil = first_guess(evidence.back(), dynamic, coil, averaged);
    fit.dynamics = fit_solenoid_dynamics(dynamic, coil, averaged);
    coil = fit.dynamics->coil;
  } else {
    fit.loop_widths = part_loop_widths(map);
    coil.hysteresis = default_hysteresis(fit.loop_widths->coercive_current_A, full_flux_Wb);
  }
  const ArmatureFrictionFit friction = fit_armature_friction(strokes, map, coil, stroke_m);
  fit.friction = friction.known;
  fit.profiles = friction.profiles;
  fit.strokes_N = friction.residual;
  fit.actuator.magnetic_force = friction.magnetic_force;
  fit.actuator.friction_N = friction.friction_N;
  fit.actuator.coil = coil;
  fit.actuator.coil_resistance = fit.flux_linkage.coil_resistance;
  fit.actuator.coercive_current_A =
      std::max(sensor::saturated_output(coil.hysteresis, 0.0), sensor::saturated_output(coil.hysteresis, 1.0));
  fit.actuator.per_wiping_flux = 0.5 / coil.hysteresis.threshold.back();
  fit.actuator.force_uncertainty_N = friction.residual.rms();
  if (recordings.dynamic != nullptr) {
    fit_uncertainty(fit.actuator, dynamic);
  } else {
    // Half a loop's half width: its size is measured, the path within it is not.
    fit.actuator.current_uncertainty_A = 0.5 * fit.actuator.coercive_current_A;
  }
  return fit;
}

}  // namespace spoolflow::calibration
