#include "spoolflow/calibration/observer.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "spoolflow/calibration/actuator.hpp"
#include "spoolflow/calibration/magnetic_force.hpp"
#include "spoolflow/calibration/metering_edge.hpp"
#include "spoolflow/calibration/position_sensor.hpp"
#include "spoolflow/calibration/spring.hpp"

namespace spoolflow::calibration {
namespace {

/// What no bench test shows. These are not fitted by calibration: they were chosen while looking at operating runs of
/// one simulated valve (docs/accuracy.md), so they are assumptions for every other, and the model file lists them.
constexpr double assumed_ageing_ratio = 4;
constexpr double assumed_ageing_s = 2.5;
constexpr double assumed_contact_stiffness_N_per_m = 5e6;
constexpr double assumed_backlash_m = 0.45e-6;
constexpr double assumed_friction_tolerance_N = 0.7;
constexpr double assumed_breakaway_share = 0.12;
constexpr double assumed_hardest_acceleration_m_per_s2 = 90;

}  // namespace

model::Observer calibrate_observer(const ObserverRecordings& recordings, const model::Valve& valve,
                                   double closed_below_m) {
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
  std::vector<AxialForceFit> axial;
  FitResidual flow;
  FitResidual axial_force;
  for (const recording::Recording* recording : recordings.axial_force_maps) {
    axial.push_back(fit_axial_force(without_zero_offset(*recording, valve.stroke_m), valve.stroke_m));
    flow.largest = std::max(flow.largest, axial.back().flow_residual.largest);
    flow.sum_of_squares += axial.back().flow_residual.sum_of_squares;
    flow.samples += axial.back().flow_residual.samples;
    axial_force.largest = std::max(axial_force.largest, axial.back().force_residual.largest);
    axial_force.sum_of_squares += axial.back().force_residual.sum_of_squares;
    axial_force.samples += axial.back().force_residual.samples;
  }
  const MeteringEdgeFit edge = fit_metering_edge(axial, spring.spring, spring.friction_half_width_N);

  model::Observer out{};
  sensor::ObserverParameters<double>& parameters = out.parameters;
  parameters.actuator = actuator.actuator;
  parameters.spring = spring.spring;
  parameters.edge = edge.edge;
  parameters.position_sensor = {position.noise_m, assumed_backlash_m, position.drift_m_per_K, position.drift_free_K,
                                assumed_hardest_acceleration_m_per_s2};
  parameters.friction = {assumed_ageing_ratio, assumed_ageing_s, assumed_contact_stiffness_N_per_m,
                         assumed_friction_tolerance_N, assumed_breakaway_share};
  parameters.pressure = {2e5, 1e6, 0.03, 0.03};
  parameters.band = {
      0.03, std::hypot(magnetic.residual.rms(), axial_force.rms(), spring.residual.rms()), flow.rms(), 1.1, 2.0, 0.03};
  parameters.closed_below_m = closed_below_m;
  parameters.largest_current_A = magnetic.largest_current_A;

  out.oil_temperature_K = {edge.edge.temperature_K.at(0), edge.edge.temperature_K.at(sensor::edge_temperatures - 1)};
  out.residuals = {
      {"spring force", "N", spring.residual.rms(), spring.residual.largest},
      {"magnetic force", "N", magnetic.residual.rms(), magnetic.residual.largest},
      {"axial force", "N", axial_force.rms(), axial_force.largest},
      {"flow rate", "m3/s", flow.rms(), flow.largest},
      {"position drift", "m", position.drift_residual_m, position.drift_residual_m},
  };
  if (actuator.dynamics) {
    for (const TestResidual& test : actuator.dynamics->tests)
      out.residuals.push_back(
          {fmt::format("solenoid_dynamic, test {}", test.test), "N", test.model_N.rms(), test.model_N.largest});
  }
  out.defaults = {"friction_ageing",
                  "contact_stiffness_N_per_m",
                  "position_backlash_m",
                  "breakaway_share",
                  "hardest_acceleration_m_per_s2",
                  "friction_tolerance_N",
                  "pressure drift and yielding",
                  "band factors"};
  if (!actuator.dynamics) {
    out.defaults.emplace_back("hysteresis_threshold_Wb");
    out.defaults.emplace_back("eddy_currents");
  }
  return out;
}

}  // namespace spoolflow::calibration
