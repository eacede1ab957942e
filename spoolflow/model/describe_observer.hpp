#pragma once
/// The observer's parameters, each described once; see describe_condensed.hpp.
#include "spoolflow/sensor/observer.hpp"

namespace spoolflow::model {

/// As describe_condensed, and visitor.volume(key, volume, layer_axis, row_axis, column_axis, VolumeKeys).
template <class Parameters, class Visitor>
void describe_observer(Parameters& parameters, Visitor&& visitor) {
  visitor.map("magnetic_force_N", parameters.actuator.magnetic_force.map, "current_A", "position_m");
  visitor.curve("magnetic_hysteresis_half_width_N", parameters.actuator.magnetic_force.hysteresis_half_width_N,
                "current_A");
  visitor.map("armature_friction_N", parameters.actuator.friction_N, "current_A", "position_m");
  visitor.number("magnetic_force_residual_N", parameters.actuator.force_residual_N, 0.0, 1e4);
  visitor.curve("spring_force_N", parameters.spring.curve, "position_m");

  auto& edge = parameters.edge;
  visitor.axis("oil_temperature_K", edge.temperature_K, sensor::edge_temperatures);
  visitor.axis("pressure_difference_Pa", edge.pressure_difference_Pa, sensor::edge_pressures);
  visitor.axis("position_m", edge.position_m, sensor::edge_positions);
  visitor.volume("flow_force_N", edge.flow_force_N);
  visitor.volume("spool_friction_N", edge.friction_N);
  visitor.volume("conductance_m3_per_s_sqrt_Pa", edge.conductance);

  visitor.number("position_noise_m", parameters.position_sensor.noise_m, 0.0, 1e-3);
  visitor.number("position_drift_m_per_K", parameters.position_sensor.drift_m_per_K, -1e-4, 1e-4);
  visitor.number("position_drift_free_K", parameters.position_sensor.drift_free_K, 0.0, 1e4);
  visitor.number("hardest_acceleration_m_per_s2", parameters.position_sensor.hardest_acceleration_m_per_s2, 1e-3, 1e5);

  visitor.number("stiction_ratio", parameters.friction.stiction_ratio, 1.0, 20.0);
  visitor.number("contact_stiffness_N_per_m", parameters.friction.contact_stiffness_N_per_m, 0.0, 1e10);
  visitor.number("gauge_tolerance_ratio", parameters.friction.gauge_tolerance_ratio, 0.0, 100.0);
  visitor.number("gauge_tolerance_N", parameters.friction.gauge_tolerance_N, 0.0, 1e4);

  visitor.number("sliding_drift_Pa_per_sqrt_s", parameters.pressure.sliding_drift_Pa_per_sqrt_s, 0.0, 1e9);
  visitor.number("resting_drift_Pa_per_sqrt_s", parameters.pressure.resting_drift_Pa_per_sqrt_s, 0.0, 1e9);
  visitor.number("yielding_s", parameters.pressure.yielding_s, 1e-5, 1e3);

  visitor.number("band_friction_share", parameters.band.friction_share, 0.0, 10.0);
  visitor.number("band_force_residual_N", parameters.band.force_residual_N, 0.0, 1e4);
  visitor.number("band_resting_share", parameters.band.resting_share, 0.0, 10.0);
  visitor.number("band_flow_residual_m3_per_s", parameters.band.flow_residual_m3_per_s, 0.0, 1.0);
  visitor.number("band_coverage_factor", parameters.band.coverage_factor, 0.0, 100.0);

  visitor.number("closed_below_m", parameters.closed_below_m, -1e-3, 0.1);
  visitor.number("largest_current_A", parameters.largest_current_A, 0.0, 1e3);
}

}  // namespace spoolflow::model
