#include "spoolflow/calibration/observer.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include <fmt/format.h>

#include "spoolflow/calibration/fits/actuator.hpp"
#include "spoolflow/calibration/fits/magnetic_force.hpp"
#include "spoolflow/calibration/fits/map_residuals.hpp"
#include "spoolflow/calibration/fits/metering_edge.hpp"
#include "spoolflow/calibration/fits/position_sensor.hpp"
#include "spoolflow/calibration/fits/spring.hpp"
#include "spoolflow/calibration/operation/band.hpp"
#include "spoolflow/calibration/operation/operation.hpp"
#include "spoolflow/model/residual_of.hpp"

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
/// Without an operating recording these two are taken larger: what they are too small, the sensor takes for pressure.
constexpr double unknown_tolerance_N = 1.2;
constexpr double unknown_backlash_m = 0.55e-6;
constexpr double assumed_hardest_acceleration_m_per_s2 = 90;
/// Of the supply, which may be any: the same for every valve.
constexpr sensor::PressureParameters<double> supply{.sliding_drift_Pa_per_sqrt_s = 1e5,
                                                    .resting_drift_Pa_per_sqrt_s = 1e6,
                                                    .least_process_noise = 0.01,
                                                    .first_process_noise = 0.05,
                                                    .yielding_s = 0.03,
                                                    .force_correlation_s = 2e-3,
                                                    .ratio_deviation = 0.03,
                                                    .ratio_memory_s = 10};
constexpr double coverage_factor = 2;

FitResidual together(const std::vector<AxialForceFit>& fits, FitResidual AxialForceFit::*residual) {
  FitResidual out;
  for (const AxialForceFit& fit : fits) {
    out.largest = std::max(out.largest, (fit.*residual).largest);
    out.sum_of_squares += (fit.*residual).sum_of_squares;
    out.samples += (fit.*residual).samples;
  }
  return out;
}

std::vector<const recording::Recording*> with_reference(const std::vector<const recording::Recording*>& operation) {
  std::vector<const recording::Recording*> out;
  for (const recording::Recording* recording : operation) {
    if (recording->has(recording::Channel::flow_reference) && recording->size() > 0) out.push_back(recording);
  }
  return out;
}

}  // namespace

ObserverCalibration calibrate_observer(const ObserverRecordings& recordings, const model::Valve& valve,
                                       double closed_below_m, const std::function<void(double)>& progress) {
  std::vector<const recording::Recording*> bench{&recordings.spring};
  bench.insert(bench.end(), recordings.axial_force_maps.begin(), recordings.axial_force_maps.end());
  const PositionSensorFit position = fit_position_sensor(bench, valve.stroke_m);
  const SpringFit spring = fit_spring(without_zero_offset(recordings.spring, valve.stroke_m), valve.stroke_m);
  const double closed_m = closed_reading_m(recordings.solenoid_force_map[recording::Channel::position], valve.stroke_m);
  const recording::Recording force_map = shifted(recordings.solenoid_force_map, closed_m);
  const MagneticForceFit magnetic = fit_magnetic_force(force_map, valve.stroke_m);
  // The armature never meets its stop in `solenoid_dynamic`: the rig's zero is that of the force map.
  std::optional<recording::Recording> dynamic;
  if (!recordings.solenoid_dynamic.empty()) dynamic = shifted(*recordings.solenoid_dynamic.front(), closed_m);
  const ActuatorFit actuator = fit_actuator({force_map, dynamic ? &*dynamic : nullptr}, magnetic, valve.stroke_m);
  std::vector<recording::Recording> axial_recordings;
  for (const recording::Recording* recording : recordings.axial_force_maps)
    axial_recordings.push_back(without_zero_offset(*recording, valve.stroke_m));
  std::vector<AxialForceFit> axial;
  for (const recording::Recording& recording : axial_recordings)
    axial.push_back(fit_axial_force(recording, valve.stroke_m));
  const FitResidual flow = together(axial, &AxialForceFit::flow_residual);
  const FitResidual axial_force = together(axial, &AxialForceFit::force_residual);
  const MeteringEdgeFit edge = fit_metering_edge(axial, spring.spring, spring.friction_half_width_N);

  ObserverCalibration calibration{};
  calibration.magnetic_force_residuals = actuator.profiles;
  if (actuator.dynamics) calibration.solenoid = actuator.dynamics->traces;
  for (const recording::Recording& recording : axial_recordings) {
    std::vector<model::MapResidual> each = axial_force_residuals(recording, spring.spring, edge.edge, valve.stroke_m);
    std::move(each.begin(), each.end(), std::back_inserter(calibration.axial_force_residuals));
  }
  model::Observer& out = calibration.observer;
  sensor::ObserverParameters<double>& parameters = out.parameters;
  parameters.actuator = actuator.actuator;
  parameters.spring = spring.spring;
  parameters.edge = edge.edge;
  parameters.position_sensor = {position.noise_m, assumed_backlash_m, position.drift_m_per_K, position.drift_free_K,
                                assumed_hardest_acceleration_m_per_s2};
  parameters.friction = assumed_friction;
  parameters.pressure = supply;
  const std::vector<const recording::Recording*> operation = with_reference(recordings.operation);
  parameters.band = {.friction_share = 0.03,
                     .force_residual_N = std::hypot(magnetic.residual.rms(), axial_force.rms(), spring.residual.rms()),
                     .flow_residual_m3_per_s = flow.rms(),
                     .coverage_factor = coverage_factor,
                     .creep_per_s = 1,
                     .unseen_factor = 4.2,
                     .reference_lag_s = 0.03};
  parameters.closed_below_m = closed_below_m;
  parameters.largest_current_A = magnetic.largest_current_A;

  out.oil_temperature_K = {edge.edge.temperature_K.at(0), edge.edge.temperature_K.at(sensor::edge_temperatures - 1)};
  out.residuals = {
      {std::string(model::of_spring_force), "N", spring.residual.rms(), spring.residual.largest},
      {std::string(model::of_magnetic_force), "N", magnetic.residual.rms(), magnetic.residual.largest},
      {std::string(model::of_axial_force), "N", axial_force.rms(), axial_force.largest},
      {std::string(model::of_flow_rate), "m3/s", flow.rms(), flow.largest},
      {"position drift", "m", position.drift_residual_m, position.drift_residual_m},
  };
  out.fits.push_back(spring.known);
  out.fits.insert(out.fits.end(), edge.known.begin(), edge.known.end());
  if (position.known) out.fits.push_back(*position.known);
  if (actuator.loop_widths) out.fits.push_back(actuator.loop_widths->known);
  if (!actuator.loop_widths) out.fits.push_back(actuator.friction);
  if (actuator.flux_linkage.measured) out.fits.push_back(actuator.flux_linkage.known);
  if (actuator.dynamics) {
    out.fits.push_back(actuator.dynamics->known);
    for (const TestResidual& test : actuator.dynamics->tests)
      out.residuals.push_back(
          {fmt::format("solenoid_dynamic, test {}", test.test), "N", test.model_N.rms(), test.model_N.largest});
  }
  if (!operation.empty()) {
    const OperationFit fit = fit_operation(parameters, operation, valve.rated_flow_m3_per_s, progress);
    out.fits.push_back(fit.known);
    out.residuals.push_back({"flow rate in operation", "m3/s", fit.flow_m3_per_s.rms(), fit.flow_m3_per_s.largest});
  } else {
    out.defaults = {"operation_friction_ratio",  "friction_ageing_ratio", "friction_ageing_s",
                    "contact_stiffness_N_per_m", "friction_tolerance_N",  "breakaway_share",
                    "position_backlash_m",       "band_friction_share",   "band_force_share",
                    "band_rest_share",           "band_tolerance_N"};
    parameters.friction.tolerance_N = unknown_tolerance_N;
    parameters.position_sensor.backlash_m = unknown_backlash_m;
    scale_band(parameters, assumed_force_error_ratio);
  }
  for (const char* assumed : {"hardest_acceleration_m_per_s2", "drifts and liveliness of the pressure",
                              "band_coverage_factor", "band_unseen_factor", "band_creep_per_s", "band_reference_lag_s"})
    out.defaults.emplace_back(assumed);
  if (!actuator.dynamics) {
    out.defaults.emplace_back("hysteresis_threshold_Wb");
    out.defaults.emplace_back("eddy_currents");
  }
  return calibration;
}

}  // namespace spoolflow::calibration
