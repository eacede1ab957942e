#include "spoolflow/calibration/observer.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <iterator>
#include <optional>

#include <fmt/format.h>

#include "spoolflow/calibration/edges/metering_edge_fit.hpp"
#include "spoolflow/calibration/edges/other_oil.hpp"
#include "spoolflow/calibration/fits/actuator_fit.hpp"
#include "spoolflow/calibration/fits/magnetic_force_fit.hpp"
#include "spoolflow/calibration/fits/map_residuals.hpp"
#include "spoolflow/calibration/fits/position_sensor.hpp"
#include "spoolflow/calibration/fits/spring_fit.hpp"
#include "spoolflow/calibration/numerics/calibration_error.hpp"
#include "spoolflow/calibration/operation/identifiable_parameters.hpp"
#include "spoolflow/calibration/operation/operation.hpp"
#include "spoolflow/calibration/operation/operation_uncertainty.hpp"
#include "spoolflow/model/residual_of.hpp"
#include "spoolflow/numerics/largest_magnitude.hpp"

namespace spoolflow::calibration {
namespace {

/// What no bench test shows, where no operating recording shows it either; else where the fit begins (operation.hpp).
/// Typical of valves of this class, and judged on the runs of five valves together (docs/accuracy.md).
constexpr sensor::FrictionParameters<double> assumed_friction{.ageing_ratio = 4,
                                                              .ageing_s = 2.5,
                                                              .contact_stiffness_N_per_m = 5e6,
                                                              .tolerance_N = 0.7,
                                                              .breakaway_share = 0.12,
                                                              .operation_ratio = 1};
constexpr double assumed_backlash_m = 0.45e-6;
constexpr double assumed_moving_mass_kg = 0.11;
constexpr double assumed_hardest_acceleration_m_per_s2 = 90;
/// Of a cylinder whose areas differ, whatever its size and mass (docs/accuracy.md, the differential cylinder).
constexpr double unsettled_cylinder_share = 0.4;
/// Of the supply, which may be any: the same for every valve.
constexpr sensor::PressureParameters<double> supply{.sliding_drift_Pa_per_sqrt_s = 3e5,
                                                    .resting_drift_Pa_per_sqrt_s = 1e6,
                                                    .least_process_noise = 1e-4,
                                                    .first_process_noise = 0.05,
                                                    .constrained_correction_s = 0.03,
                                                    .force_correlation_s = 2e-3,
                                                    .ratio_deviation = 0.03,
                                                    .ratio_memory_s = 10};
constexpr double coverage_factor = 2;

/// More than that no valve's forces are off in operation, measured by what its benches leave open.
constexpr double largest_force_error_ratio = 7;

constexpr const char* of_operation = "flow rate in operation";

/// What a coil's voltage reaches in a recording [V], either way; 0 where none was measured.
double largest_voltage_V(const recording::Recording& recording) {
  using recording::Channel;
  double largest_V = 0;
  for (const Channel channel : {Channel::voltage, Channel::voltage_a, Channel::voltage_b})
    largest_V = std::max(largest_V, numerics::largest_magnitude(recording.column(channel)));
  return largest_V;
}

FitResidual together(const std::vector<AxialForceFit>& fits, FitResidual AxialForceFit::*residual) {
  FitResidual out;
  for (const AxialForceFit& fit : fits) out += fit.*residual;
  return out;
}

std::vector<OperatingRun> with_reference(const std::vector<OperatingRun>& runs) {
  std::vector<OperatingRun> out;
  for (const OperatingRun& run : runs) {
    if (run.recording->has(recording::Channel::flow_reference) && run.recording->size() > 0) out.push_back(run);
  }
  return out;
}

/// What the bench recordings give, the position sensor's drift taken off each.
struct BenchFits {
  PositionSensorFit position;
  SpringFit spring;
  MagneticForceFit magnetic;
  ActuatorFit actuator;
  std::deque<recording::Recording> axial_recordings;  ///< a deque: `maps` points to them
  AxialForceMaps maps;
  PathFit axial;
  MeteringEdgeFit edge;
};

/// The axial force's recordings without the position sensor's drift.
void take_off_drift(const AxialForceMaps& measured, double stroke_m, BenchFits& out) {
  out.maps = measured;
  for (auto* recordings : {&out.maps.joined, &out.maps.inlet, &out.maps.outlet}) {
    for (const recording::Recording*& recording : *recordings) {
      out.axial_recordings.push_back(without_zero_offset(*recording, stroke_m));
      recording = &out.axial_recordings.back();
    }
  }
}

BenchFits fit_bench(const CampaignRecordings& recordings, double stroke_m) {
  std::vector<const recording::Recording*> bench = recordings.axial_force_maps.recordings();
  bench.insert(bench.begin(), &recordings.spring);
  BenchFits out{};
  out.position =
      recordings.flow_bench != nullptr ? recordings.flow_bench->position : fit_position_sensor(bench, stroke_m);
  out.spring = fit_spring(without_zero_offset(recordings.spring, stroke_m), stroke_m);
  const double closed_m = closed_reading_m(recordings.solenoid_force_map[recording::Channel::position], stroke_m);
  const recording::Recording force_map = shifted(recordings.solenoid_force_map, closed_m);
  out.magnetic = fit_magnetic_force(force_map, stroke_m);
  // The armature never meets its stop in `solenoid_dynamic`: the rig's zero is that of the force map.
  std::optional<recording::Recording> dynamic;
  if (!recordings.solenoid_dynamic.empty()) dynamic = shifted(*recordings.solenoid_dynamic.front(), closed_m);
  out.actuator = recordings.actuator_is_inferred()
                     ? recordings.flow_bench->actuator
                     : fit_actuator({force_map, dynamic ? &*dynamic : nullptr}, out.magnetic, stroke_m);
  take_off_drift(recordings.axial_force_maps, stroke_m, out);
  out.axial = fit_path(out.maps, out.spring.spring, stroke_m);
  out.edge = fit_metering_edge(out.axial.path, out.spring.spring, out.spring.friction_half_width_N);
  if (is_of_one_temperature(out.edge))
    continue_to_other_oil(out.edge.edge, out.edge.lowest_temperature_K, recordings.fluid);
  return out;
}

model::BenchResiduals residuals_on_bench(const BenchFits& fits, double stroke_m) {
  model::BenchResiduals out;
  out.magnetic_force = fits.actuator.profiles;
  if (fits.actuator.dynamics) out.solenoid = fits.actuator.dynamics->traces;
  const auto add = [&](const std::vector<const recording::Recording*>& recordings,
                       const sensor::MeteringEdge<double>& edge) {
    for (const recording::Recording* recording : recordings) {
      std::vector<model::MapResidual> each = axial_force_residuals(*recording, fits.spring.spring, edge, stroke_m);
      std::move(each.begin(), each.end(), std::back_inserter(out.axial_force));
    }
  };
  // Of one edge alone what its own map leaves: the path's is of both.
  const auto own = [&](const std::vector<AxialForceFit>& measured) {
    return fit_metering_edge(measured, fits.spring.spring, fits.spring.friction_half_width_N).edge;
  };
  add(fits.maps.joined, fits.maps.edges_are_unknown() ? own(fits.axial.measured.front()) : fits.edge.edge);
  if (!fits.maps.inlet.empty()) {
    add(fits.maps.inlet, own(fits.axial.measured.front()));
    add(fits.maps.outlet, own(fits.axial.measured.back()));
  }
  return out;
}

/// With what only operation shows as assumed.
sensor::ObserverParameters<double> parameters_from(const BenchFits& fits, const model::Valve& valve,
                                                   double closed_below_m) {
  sensor::ObserverParameters<double> out{};
  out.actuator = fits.actuator.actuator;
  out.spring = fits.spring.spring;
  out.edge = fits.edge.edge;
  out.position_sensor = {fits.position.noise_m, assumed_backlash_m, fits.position.drift_m_per_K,
                         fits.position.drift_free_K, assumed_hardest_acceleration_m_per_s2};
  out.friction = assumed_friction;
  out.pressure = supply;
  out.band = {.friction_share = 0.03,
              .force_residual_N = std::hypot(fits.magnetic.residual.rms(),
                                             together(fits.axial.path, &AxialForceFit::force_residual).rms(),
                                             fits.spring.residual.rms()),
              .flow_residual_m3_per_s = together(fits.axial.path, &AxialForceFit::flow_residual).rms(),
              .coverage_factor = coverage_factor,
              .creep_per_s = 1,
              .unobserved_factor = 2.4};
  out.inlet = fits.axial.inlet;
  out.unsettled_load_share = fits.axial.equal_flows ? 0 : unsettled_cylinder_share;
  out.moving_mass_kg = valve.moving_mass_kg.value_or(assumed_moving_mass_kg);
  out.closed_below_m = closed_below_m;
  if (valve.open_stop_m) out.stopped_above_m = stopped_above_m(*valve.open_stop_m);
  out.largest_current_A = fits.magnetic.largest_current_A;
  return out;
}

std::vector<model::Residual> residuals_of_fits(const BenchFits& fits) {
  const FitResidual axial_force = together(fits.axial.path, &AxialForceFit::force_residual);
  const FitResidual flow = together(fits.axial.path, &AxialForceFit::flow_residual);
  std::vector<model::Residual> out{
      {std::string(model::of_spring_force), "N", fits.spring.residual.rms(), fits.spring.residual.largest},
      {std::string(model::of_magnetic_force), "N", fits.magnetic.residual.rms(), fits.magnetic.residual.largest},
      {std::string(model::of_axial_force), "N", axial_force.rms(), axial_force.largest},
      {std::string(model::of_flow_rate), "m3/s", flow.rms(), flow.largest},
      {"position drift", "m", fits.position.drift_residual_m, fits.position.drift_residual_m},
  };
  if (fits.actuator.dynamics) {
    for (const TestResidual& test : fits.actuator.dynamics->tests)
      out.push_back(
          {fmt::format("solenoid_dynamic, test {}", test.test), "N", test.model_N.rms(), test.model_N.largest});
  }
  return out;
}

std::vector<model::Fit> known_of_bench(const BenchFits& fits, bool on_force_benches) {
  std::vector<model::Fit> out;
  if (on_force_benches) {
    out.push_back(fits.spring.known);
    out.insert(out.end(), fits.edge.known.begin(), fits.edge.known.end());
  }
  if (fits.position.known) out.push_back(*fits.position.known);
  if (const std::optional<EdgeRatio>& edges = fits.maps.edge_ratio) {
    constexpr double standard = 4;  // deviations in the range of 95 %
    out.push_back(
        {"edges of the path, joined on the bench, as operation identifies them",
         {{"conductance_ratio_of_outlet_to_inlet", edges->value, (edges->highest - edges->lowest) / standard}},
         {1.0}});
  }
  const ActuatorFit& actuator = fits.actuator;
  out.push_back(actuator.loop_widths ? actuator.loop_widths->known : actuator.friction);
  if (actuator.flux_linkage.measured) out.push_back(actuator.flux_linkage.known);
  if (actuator.dynamics) out.push_back(actuator.dynamics->known);
  return out;
}

/// Throws CalibrationError where operation contradicts the benches.
void require_agreement(const OperationFit& fit, const std::vector<OperatingRun>& runs) {
  if (fit.force_error_ratio <= largest_force_error_ratio) return;
  throw CalibrationError(fmt::format(
      "{}: the flow in operation differs from that of the bench recordings by {:.1f} times their uncertainty, at "
      "most {:.0f} is credible; give the load's area_ratio under [load] where it passes unequal flows over both edges, "
      "compare the signs and units of both, or leave the operation out",
      runs.front().recording->file.filename().string(), fit.force_error_ratio, largest_force_error_ratio));
}

/// Without an operating recording.
void assume_operation(model::Observer& observer) {
  observer.defaults = {"operation_friction_ratio",  "friction_ageing_ratio", "friction_ageing_s",
                       "contact_stiffness_N_per_m", "friction_tolerance_N",  "breakaway_share",
                       "position_backlash_m",       "band_friction_share",   "band_force_share",
                       "band_rest_share",           "band_tolerance_N",      "moving_mass_kg"};
  assume_rest(observer.parameters);
  scale_band(observer.parameters, assumed_force_error_ratio);
}

}  // namespace

double stopped_above_m(double open_stop_m) {
  constexpr double tolerance_m = 20e-6;  // zero and temperature of a position sensor
  return open_stop_m - tolerance_m;
}

ObserverCalibration calibrate_on_bench(const CampaignRecordings& recordings, const model::Valve& valve,
                                       double closed_below_m) {
  const BenchFits fits = fit_bench(recordings, valve.stroke_m);
  ObserverCalibration calibration{};
  calibration.bench = residuals_on_bench(fits, valve.stroke_m);
  model::Observer& out = calibration.observer;
  out.parameters = parameters_from(fits, valve, closed_below_m);
  out.parameters.largest_voltage_V =
      std::max(largest_voltage_V(recordings.solenoid_force_map),
               recordings.flow_bench != nullptr ? recordings.flow_bench->largest_voltage_V : 0);
  for (const recording::Recording* dynamic : recordings.solenoid_dynamic)
    out.parameters.largest_voltage_V = std::max(out.parameters.largest_voltage_V, largest_voltage_V(*dynamic));
  double& flow_residual_m3_per_s = out.parameters.band.flow_residual_m3_per_s;
  if (recordings.flow_bench != nullptr) {
    double& force_residual_N = out.parameters.band.force_residual_N;
    force_residual_N = std::max(force_residual_N, recordings.flow_bench->force_residual_N);
    flow_residual_m3_per_s = std::max(flow_residual_m3_per_s, recordings.flow_bench->flow_residual_m3_per_s);
  }
  flow_residual_m3_per_s =
      flow_residual_with_unknown_edges(fits.maps, flow_residual_m3_per_s, valve.rated_flow_m3_per_s);
  const auto& temperature_K = fits.edge.edge.temperature_K;
  out.oil_temperature_K = {temperature_K.at(0), temperature_K.at(sensor::edge_temperatures - 1)};
  out.residuals = residuals_of_fits(fits);
  out.fits = known_of_bench(fits, recordings.flow_bench == nullptr);
  if (recordings.flow_bench != nullptr) {
    widen(out.residuals, *recordings.flow_bench);
    out.fits.insert(out.fits.end(), recordings.flow_bench->known.begin(), recordings.flow_bench->known.end());
  }
  out.defaults = {"hardest_acceleration_m_per_s2", "drifts and process noise of the pressure", "band_coverage_factor",
                  "band_unobserved_factor", "band_creep_per_s"};
  if (fits.maps.edges_are_assumed()) out.defaults.emplace_back(model::each_edge_alone);
  if (!fits.actuator.dynamics) out.defaults.emplace_back("hysteresis_threshold_Wb");
  if (!fits.actuator.dynamics && !recordings.actuator_is_inferred()) out.defaults.emplace_back("eddy_currents");
  return calibration;
}

void calibrate_in_operation(model::Observer& observer, const std::vector<OperatingRun>& runs, const InOperation& valve,
                            const std::function<void(double)>& progress) {
  for (const OperatingRun& run : runs)
    observer.parameters.largest_voltage_V =
        std::max(observer.parameters.largest_voltage_V, largest_voltage_V(*run.recording));
  const std::vector<std::string> of_bench = std::move(observer.defaults);
  const std::vector<OperatingRun> used = with_reference(runs);
  if (!used.empty()) {
    OperationFit fit = fit_operation(observer.parameters, used, valve, progress);
    if (fit.force_error_ratio < valve.least_ratio) {
      fit.force_error_ratio = valve.least_ratio;
      scale_band(observer.parameters, fit.force_error_ratio);
    }
    require_agreement(fit, used);
    observer.fits.push_back(fit.known);
    observer.defaults = fit.not_identifiable;
    observer.residuals.push_back({of_operation, "m3/s", fit.flow_m3_per_s.rms(), fit.flow_m3_per_s.largest});
  } else {
    assume_operation(observer);
  }
  if (valve.mass_is_declared) std::erase(observer.defaults, "moving_mass_kg");
  observer.defaults.insert(observer.defaults.end(), of_bench.begin(), of_bench.end());
}

void take_over_operation(const model::Observer& one, model::Observer& other) {
  share_operation(one.parameters, other.parameters);
  other.parameters.largest_voltage_V = std::max(one.parameters.largest_voltage_V, other.parameters.largest_voltage_V);
  other.defaults = one.defaults;
  for (const model::Residual& residual : one.residuals) {
    if (residual.of == of_operation) other.residuals.push_back(residual);
  }
  for (const model::Fit& fit : one.fits) {
    if (fit.of == fit_of_operation) other.fits.push_back(fit);
  }
}

}  // namespace spoolflow::calibration
