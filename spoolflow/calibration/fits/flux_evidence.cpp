#include "spoolflow/calibration/fits/flux_evidence.hpp"

#include <cmath>

#include "spoolflow/numerics/crossing.hpp"

namespace spoolflow::calibration {
namespace {

/// The mean position while the armature is held, from sample `begin` to the next restart: free of the sensor's noise.
double held_position_m(const SolenoidSamples& samples, std::size_t begin) {
  double sum = 0;
  std::size_t end = begin;
  for (; end < samples.size() && (end == begin || samples.restarts[end] == 0); ++end)
    sum += samples.samples[end].position_m;
  return sum / static_cast<double>(end - begin);
}

}  // namespace

FluxEvidence evidence_from_force(const SolenoidSamples& samples, const sensor::MagneticForce<double>& magnetic_force) {
  const double largest_A = magnetic_force.map.row_axis.at(sensor::force_map_currents - 1);
  FluxEvidence out{&samples, std::vector<double>(samples.size(), std::nan(""))};
  double held_m = 0;
  double least_N = 0;
  double most_N = 0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    if (samples.restarts[k] != 0) {
      held_m = held_position_m(samples, k);
      least_N = magnetic_force.at(0.1 * largest_A, held_m).value;
      most_N = magnetic_force.at(largest_A, held_m).value;
    }
    const double force_N = samples.force_N[k];
    if (force_N < least_N || force_N > most_N) continue;
    out.magnetising_current_A[k] = numerics::crossing(
        {0, largest_A}, force_N, [&](double current_A) { return magnetic_force.at(current_A, held_m).value; });
  }
  return out;
}

FluxEvidence evidence_from_current(const SolenoidSamples& samples) {
  FluxEvidence out{&samples, {}};
  out.magnetising_current_A.reserve(samples.size());
  for (const auto& sample : samples.samples) out.magnetising_current_A.push_back(sample.current_A);
  return out;
}

std::vector<double> magnetising_currents_A(const SolenoidSamples& samples, const sensor::Coil<double>& coil) {
  sensor::CoilState<double> state;
  std::vector<double> out;
  out.reserve(samples.size());
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const auto& sample = samples.samples[k];
    const auto position =
        sensor::locate<sensor::flux_map_positions>(coil.flux_linkage.map.column_axis, sample.position_m);
    sensor::follow_current(coil, state, {sample.time_step_s, sample.current_A}, position, samples.restarts[k] != 0);
    out.push_back(state.magnetising_current_A);
  }
  return out;
}

}  // namespace spoolflow::calibration
