#include "spoolflow/calibration/flow_bench/flow_bench_fit.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/calibration/fits/actuator_fit.hpp"
#include "spoolflow/calibration/flow_bench/coenergy.hpp"
#include "spoolflow/calibration/numerics/calibration_error.hpp"

namespace spoolflow::calibration {
namespace {

/// Loops of solenoid irons are some percent of the current wide, and solid iron takes some 20 ms to let the flux in.
constexpr CoilSizes usual_coil{0.012, 0.005, 0.004, 0.008};
constexpr CoilSizes usual_coil_deviation{0.01, 0.01, 0.004, 0.01};

/// A slow stroke changes the flux by less than its noise within some milliseconds. A coil warms in minutes.
constexpr double longest_flux_window_s = 1;

double full_flux_Wb(const sensor::FluxLinkage<double>& flux_linkage) {
  return flux_linkage.map.node(sensor::flux_map_currents - 1 - sensor::flux_map_currents_below_zero,
                               sensor::flux_map_positions - 1);
}

sensor::Coil<double> coil_of(const CoilSizes& sizes, const FluxLinkageFit& flux_linkage, double largest_A) {
  sensor::Coil<double> coil;
  coil.flux_linkage = flux_linkage.flux_linkage;
  const double full_Wb = full_flux_Wb(coil.flux_linkage);
  coil.hysteresis = default_hysteresis(1.0, full_Wb);
  for (std::size_t e = 0; e < sensor::hysteresis_elements; ++e) {
    coil.hysteresis.stiffness_increase[e] = sizes[1] * coil.hysteresis.stiffness[e];
    coil.hysteresis.stiffness[e] *= sizes[0];
  }
  coil.eddy_currents.classical_A_per_V = sizes[2];
  coil.eddy_currents.excess_A_per_rootV = sizes[3];
  coil.eddy_currents.smallest_rate_V = smallest_rate_V(flux_linkage, largest_A);
  return coil;
}

/// The coil current at each sample's instant, between its means over the steps before and after.
std::vector<double> current_at_instants(const SolenoidSamples& coil) {
  std::vector<double> out;
  for (std::size_t k = 0; k < coil.size(); ++k)
    out.push_back(0.5 * (coil.samples[k].current_A + coil.samples[std::min(k + 1, coil.size() - 1)].current_A));
  return out;
}

std::vector<double> at_samples(const std::vector<SlidingSample>& samples, const std::vector<double>& magnetising_A) {
  std::vector<double> out;
  for (const SlidingSample& sample : samples) out.push_back(magnetising_A[sample.sample]);
  return out;
}

std::vector<RunForces> forces_of(const std::vector<TrackedRun>& runs, const CoilSizes& sizes,
                                 const FluxLinkageFit& flux_linkage, double largest_A) {
  std::vector<RunForces> out;
  for (const TrackedRun& run : runs) {
    const std::vector<double> current_A = magnetising_currents_A(run.coil, coil_of(sizes, flux_linkage, largest_A));
    RunForces forces{&run, &run.sliding, at_samples(run.sliding, current_A), {}, {}};
    forces.per_size.resize(forces.magnetising_A.size());
    for (std::size_t n = 0; n < coil_sizes; ++n) {
      CoilSizes turned = sizes;
      const double step = 0.2 * usual_coil_deviation[n];
      turned[n] += step;
      const std::vector<double> other =
          at_samples(run.sliding, magnetising_currents_A(run.coil, coil_of(turned, flux_linkage, largest_A)));
      for (std::size_t k = 0; k < other.size(); ++k)
        forces.per_size[k][n] = (other[k] - forces.magnetising_A[k]) / step;
    }
    out.push_back(std::move(forces));
  }
  return out;
}

FluxLinkageFit flux_linkage_of(const std::vector<TrackedRun>& runs, const std::vector<std::vector<double>>& current_A,
                               const sensor::MagneticForce<double>& axes) {
  std::vector<FluxEvidence> evidence;
  for (std::size_t r = 0; r < runs.size(); ++r)
    evidence.push_back({&runs[r].coil, current_A[r], longest_flux_window_s});
  FluxLinkageFit out = fit_flux_linkage(evidence, axes);
  if (out.measured) return out;
  throw CalibrationError(
      fmt::format("{}: without the coil's voltage nothing on a flow bench shows the magnetic force; give \"voltage\" "
                  "in the file or "
                  "in a channel map, or record protocol \"solenoid_force_map\"",
                  runs.front().coil.file));
}

/// Of the first runs, which are under held pressure differences where there are any, and of the axial-force rig.
std::vector<double> rising_temperatures_K(const std::vector<TrackedRun>& runs, std::size_t first,
                                          const std::vector<AxialForceFit>& axial) {
  constexpr double unknown_K = 323.15;
  std::vector<double> all, out;
  for (std::size_t k = 0; k < first; ++k) all.push_back(runs[k].oil_temperature_K);
  for (const AxialForceFit& fit : axial) all.push_back(fit.oil_temperature_K);
  std::erase_if(all, [](double each) { return std::isnan(each); });
  std::sort(all.begin(), all.end());
  for (const double each : all) {
    if (out.empty() || each > out.back() + same_oil_K) out.push_back(each);
  }
  return out.empty() ? std::vector<double>{unknown_K} : out;
}

double largest_current_A(const std::vector<TrackedRun>& runs) {
  double out = 0;
  for (const TrackedRun& run : runs)
    for (const auto& sample : run.coil.samples) out = std::max(out, sample.current_A);
  return out;
}

std::vector<TrackedRun> track_all(const FlowBenchRecordings& recordings, double stroke_m) {
  std::vector<TrackedRun> out;
  for (const recording::Recording* each : recordings.metering) out.push_back(track_run(*each, stroke_m, true));
  for (const recording::Recording* each : recordings.metering_outlet)
    out.emplace_back(track_run(*each, stroke_m, true)).edge = 1;
  for (const recording::Recording* each : recordings.unpressurised) out.push_back(track_run(*each, stroke_m, false));
  if (recordings.one_edge_at_a_time()) return out;  // at work both share the pressure difference
  for (const recording::Recording* each : recordings.operation) {
    if (!pressure_difference_Pa(*each).empty()) out.push_back(track_run(*each, stroke_m, true));
  }
  return out;
}

void require_sliding(const std::vector<TrackedRun>& runs) {
  constexpr std::size_t least_samples = 1000;
  std::size_t samples = 0;
  for (const TrackedRun& run : runs) samples += run.passing.size();
  if (samples >= least_samples) return;
  throw CalibrationError(
      fmt::format("{}: on the flow bench the spool slides in {} samples only, {} are needed to identify the "
                  "forces; stroke the "
                  "valve over its whole stroke both ways, at 5 %/s or faster, with the electronics' dither off",
                  runs.empty() ? std::string("the campaign") : runs.front().coil.file, samples, least_samples));
}

/// What the force rigs measured, at the layout's knots.
std::vector<MeasuredForce> at_knots(const MeasuredForces& measured, const ForceLayout& layout) {
  std::vector<MeasuredForce> out;
  for (int k = 0; measured.spring && k < layout.spring.count; ++k) {
    const double x = layout.stroke_m * k / (layout.spring.count - 1);
    out.push_back({x, 0, std::nan(""), measured.spring->spring.at(x).value});
  }
  for (const AxialForceFit& fit : measured.axial) {
    for (const model::AxialForceLoop& loop : fit.loops) {
      for (int k = 0; k < layout.force.count; ++k) {
        const double share = static_cast<double>(k) / (layout.force.count - 1);
        const auto at = static_cast<std::size_t>(std::lround(share * static_cast<double>(loop.position_m.size() - 1)));
        out.push_back({loop.position_m[at], loop.pressure_difference_Pa[at], fit.oil_temperature_K,
                       0.5 * (loop.opening_N[at] + loop.closing_N[at])});
      }
    }
  }
  return out;
}

/// All forces but the magnetic one, which `out` has, and armature friction where it was measured apart.
void fit_other_forces(FlowBenchFit& out, ForcePriors priors, const std::vector<TrackedRun>& runs,
                      const sensor::ActuatorParameters<double>* measured) {
  constexpr double held = 1e-6;
  priors.map_share = priors.map_bend = 1e-4;
  priors.coil = out.coil_sizes;
  priors.coil_deviation = {held, held, held, held};
  priors.mean_travel_m = 1e-4;
  std::vector<RunForces> forces;
  for (const TrackedRun& run : runs) {
    RunForces each{&run, &run.passing, at_samples(run.passing, magnetising_currents_A(run.coil, out.coil)), {}, {}};
    each.per_size.resize(each.magnetising_A.size());
    for (std::size_t k = 0; measured != nullptr && k < run.passing.size(); ++k)
      each.armature_friction_N.push_back(
          measured->friction_N.at(each.magnetising_A[k], run.passing[k].position_m).value);
    forces.push_back(std::move(each));
  }
  out.forces = solve_forces(out.layout, priors, out.magnetic_force, forces, out.coil_sizes, {});
}

/// The coil as a force bench measured it.
void fit_with_actuator(FlowBenchFit& out, const ForcePriors& priors, const ActuatorFit& actuator,
                       const std::vector<TrackedRun>& runs) {
  out.flux_linkage = actuator.flux_linkage;
  out.coil = actuator.actuator.coil;
  out.magnetic_force = actuator.actuator.magnetic_force;
  fit_other_forces(out, priors, runs, &actuator.actuator);
}

/// Throws CalibrationError where the coil's voltage shows no force.
void require_force(const FlowBenchFit& fit, const std::string& file) {
  constexpr double least_N = 1;
  const ForceLayout& layout = fit.layout;
  double largest_N = 0;
  for (int share = 1; share < 8; ++share)
    largest_N = std::max(largest_N, fit.magnetic_force.at(layout.largest_current_A, layout.stroke_m * share / 8).value);
  if (largest_N > least_N) return;
  throw CalibrationError(
      fmt::format("{}: flux linkage from current and voltage gives {:.2g} N at {:.2g} A, a solenoid pulls with more; "
                  "stroke without "
                  "dither, and record current and voltage as means over the sample",
                  file, largest_N, layout.largest_current_A));
}

/// The coil from its voltage and from motion, in turn.
void fit_with_coil(FlowBenchFit& out, ForcePriors priors, const std::vector<TrackedRun>& runs) {
  const double largest_A = out.layout.largest_current_A;
  priors.coil = out.coil_sizes = usual_coil;
  priors.coil_deviation = usual_coil_deviation;
  const sensor::MagneticForce<double> axes = empty_force_map(largest_A, out.layout.stroke_m);
  std::vector<std::vector<double>> current_A;
  for (const TrackedRun& run : runs) current_A.push_back(current_at_instants(run.coil));
  constexpr int flux_rounds = 3, coil_rounds = 3;
  for (int flux_round = 0; flux_round < flux_rounds; ++flux_round) {
    FluxLinkageFit flux_linkage = flux_linkage_of(runs, current_A, axes);
    // What was taken off the current after the round before has to explain the voltage better than the current itself.
    if (flux_round > 0 && flux_linkage.residual.rms() > out.flux_linkage.residual.rms()) break;
    out.flux_linkage = std::move(flux_linkage);
    const sensor::MagneticForce<double> coenergy_force = force_of_coenergy(out.flux_linkage.flux_linkage);
    for (int round = 0; round < coil_rounds; ++round) {
      const std::vector<RunForces> forces = forces_of(runs, out.coil_sizes, out.flux_linkage, largest_A);
      out.forces = solve_forces(out.layout, priors, coenergy_force, forces, out.coil_sizes, out.forces.unknowns);
      for (int n = 0; n < coil_sizes; ++n) {
        const double least = n == 1 ? -0.8 * out.coil_sizes[0] : 0;
        out.coil_sizes[static_cast<std::size_t>(n)] = std::max(least, out.forces.unknowns(out.layout.coil_at(n)));
      }
    }
    out.coil = coil_of(out.coil_sizes, out.flux_linkage, largest_A);
    out.magnetic_force = corrected_map(out.layout, coenergy_force, out.forces.unknowns);
    for (std::size_t r = 0; r < runs.size(); ++r) current_A[r] = magnetising_currents_A(runs[r].coil, out.coil);
  }
  // Only a spool that slides evenly shows the coil: sticking and slipping would pass for hysteresis.
  const ForceSolution evenly = std::move(out.forces);
  fit_other_forces(out, priors, runs, nullptr);
  out.forces.covariance = evenly.covariance;
  out.forces.residual_N = std::max(out.forces.residual_N, evenly.residual_N);
}

}  // namespace

FlowBenchFit fit_flow_bench(const FlowBenchRecordings& recordings, const MeasuredForces& measured, double stroke_m) {
  const std::vector<TrackedRun> runs = track_all(recordings, stroke_m);
  require_sliding(runs);
  const double largest_A =
      measured.actuator ? measured.actuator->actuator.magnetic_force.map.row_axis.at(sensor::force_map_currents - 1)
                        : largest_current_A(runs);
  const std::size_t metered = recordings.all_metering().size();
  FlowBenchFit out{
      ForceLayout(largest_A, stroke_m, rising_temperatures_K(runs, std::max<std::size_t>(1, metered), measured.axial),
                  recordings.one_edge_at_a_time() ? 2 : 1),
      {},
      {},
      {},
      {},
      {}};
  ForcePriors priors;
  priors.measured = at_knots(measured, out.layout);
  if (!priors.measured.empty()) priors.map_share = coenergy_scale_95;
  if (measured.actuator) {
    fit_with_actuator(out, priors, *measured.actuator, runs);
  } else {
    fit_with_coil(out, priors, runs);
    require_force(out, runs.front().coil.file);
  }
  return out;
}

}  // namespace spoolflow::calibration
