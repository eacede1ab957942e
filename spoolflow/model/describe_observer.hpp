#pragma once
/// The observer's parameters, each described once; see describe_condensed.hpp.
#include "spoolflow/sensor/observer.hpp"

namespace spoolflow::model {

/// As describe_condensed, and visitor.list(key, array, lowest, highest).
template <class Actuator, class Visitor>
void describe_coil(Actuator& actuator, Visitor& visitor) {
  visitor.map("flux_linkage_Wb", actuator.coil.flux_linkage.map, "magnetising_current_A", "position_m");
  auto& hysteresis = actuator.coil.hysteresis;
  visitor.list("hysteresis_threshold_Wb", hysteresis.threshold, 0.0, 1e6);
  visitor.list("hysteresis_stiffness_A_per_Wb", hysteresis.stiffness, 0.0, 1e9);
  visitor.list("hysteresis_stiffness_increase_A_per_Wb", hysteresis.stiffness_increase, -1e9, 1e9);
  visitor.number("hysteresis_per_full_flux_1_per_Wb", hysteresis.per_full_flux, 0.0, 1e9);
  auto& eddy_currents = actuator.coil.eddy_currents;
  visitor.number("classical_eddy_current_A_per_V", eddy_currents.classical_A_per_V, 0.0, 1e3);
  visitor.number("excess_eddy_current_A_per_rootV", eddy_currents.excess_A_per_rootV, 0.0, 1e3);
  visitor.number("smallest_flux_rate_V", eddy_currents.smallest_rate_V, 1e-9, 1e3);
  auto& resistance = actuator.coil_resistance;
  visitor.number("coil_resistance_Ohm", resistance.resistance_Ohm, 0.0, 1e4);
  visitor.number("coil_resistance_uncertainty_Ohm", resistance.uncertainty_Ohm, 0.0, 1e4);
  visitor.number("coil_resistance_drift_Ohm_per_root_s", resistance.drift_Ohm_per_root_s, 0.0, 1e4);
  visitor.number("voltage_noise_V_root_s", resistance.voltage_noise_V_root_s, 0.0, 1e3);
  visitor.number("coercive_current_A", actuator.coercive_current_A, 0.0, 1e3);
  visitor.number("per_wiping_flux_1_per_Wb", actuator.per_wiping_flux, 0.0, 1e9);
  visitor.number("magnetic_force_uncertainty_N", actuator.force_uncertainty_N, 0.0, 1e4);
  visitor.number("magnetising_current_uncertainty_A", actuator.current_uncertainty_A, 0.0, 1e3);
  visitor.number("eddy_current_uncertainty", actuator.eddy_uncertainty, 0.0, 1e3);
}

/// As describe_condensed and describe_coil, and visitor.volume(key, volume, layer_axis, row_axis, column_axis,
/// VolumeKeys).
template <class Parameters, class Visitor>
void describe_observer(Parameters& parameters, Visitor&& visitor) {
  visitor.map("magnetic_force_N", parameters.actuator.magnetic_force.map, "current_A", "position_m");
  visitor.curve("magnetic_hysteresis_half_width_N", parameters.actuator.magnetic_force.hysteresis_half_width_N,
                "current_A");
  visitor.map("armature_friction_N", parameters.actuator.friction_N, "current_A", "position_m");
  describe_coil(parameters.actuator, visitor);
  visitor.curve("spring_force_N", parameters.spring.curve, "position_m");

  auto& edge = parameters.edge;
  visitor.axis("oil_temperature_K", edge.temperature_K, sensor::edge_temperatures);
  visitor.axis("pressure_difference_Pa", edge.pressure_difference_Pa, sensor::edge_pressures);
  visitor.axis("position_m", edge.position_m, sensor::edge_positions);
  visitor.volume("flow_force_N", edge.flow_force_N);
  visitor.volume("spool_friction_N", edge.friction_N);
  visitor.volume("conductance_m3_per_s_sqrt_Pa", edge.conductance);

  visitor.number("position_noise_m", parameters.position_sensor.noise_m, 0.0, 1e-3);
  visitor.number("position_backlash_m", parameters.position_sensor.backlash_m, 0.0, 1e-3);
  visitor.number("position_drift_m_per_K", parameters.position_sensor.drift_m_per_K, -1e-4, 1e-4);
  visitor.number("position_drift_free_K", parameters.position_sensor.drift_free_K, 0.0, 1e4);
  visitor.number("hardest_acceleration_m_per_s2", parameters.position_sensor.hardest_acceleration_m_per_s2, 1e-3, 1e5);

  visitor.number("friction_ageing_ratio", parameters.friction.ageing_ratio, 1.0, 20.0);
  visitor.number("friction_ageing_s", parameters.friction.ageing_s, 1e-4, 1e4);
  visitor.number("contact_stiffness_N_per_m", parameters.friction.contact_stiffness_N_per_m, 0.0, 1e10);
  visitor.number("friction_tolerance_N", parameters.friction.tolerance_N, 0.0, 1e4);
  visitor.number("breakaway_share", parameters.friction.breakaway_share, 0.0, 10.0);
  visitor.number("operation_friction_ratio", parameters.friction.operation_ratio, 0.05, 2.5);

  visitor.number("sliding_drift_Pa_per_sqrt_s", parameters.pressure.sliding_drift_Pa_per_sqrt_s, 0.0, 1e9);
  visitor.number("resting_drift_Pa_per_sqrt_s", parameters.pressure.resting_drift_Pa_per_sqrt_s, 0.0, 1e9);
  visitor.number("least_liveliness", parameters.pressure.least_process_noise, 1e-6, 1.0);
  visitor.number("first_liveliness", parameters.pressure.first_process_noise, 1e-6, 1.0);
  visitor.number("force_correlation_s", parameters.pressure.force_correlation_s, 1e-6, 10.0);
  visitor.number("friction_ratio_deviation", parameters.pressure.ratio_deviation, 1e-3, 2.0);
  visitor.number("friction_ratio_memory_s", parameters.pressure.ratio_memory_s, 1e-3, 1e6);
  visitor.number("yielding_s", parameters.pressure.yielding_s, 1e-5, 1e3);

  visitor.number("band_friction_share", parameters.band.friction_share, 0.0, 10.0);
  visitor.number("band_force_residual_N", parameters.band.force_residual_N, 0.0, 1e4);
  visitor.number("band_flow_residual_m3_per_s", parameters.band.flow_residual_m3_per_s, 0.0, 1.0);
  visitor.number("band_coverage_factor", parameters.band.coverage_factor, 0.0, 100.0);
  visitor.number("band_force_share", parameters.band.force_share, 0.0, 10.0);
  visitor.number("band_rest_share", parameters.band.rest_share, 0.0, 100.0);
  visitor.number("band_tolerance_N", parameters.band.tolerance_N, 0.0, 1e4);
  visitor.number("band_creep_per_s", parameters.band.creep_per_s, 0.0, 10.0);
  visitor.number("band_unseen_factor", parameters.band.unseen_factor, 1e-3, 100.0);
  visitor.number("band_reference_lag_s", parameters.band.reference_lag_s, 0.0, 10.0);

  visitor.number("closed_below_m", parameters.closed_below_m, -1e-3, 0.1);
  visitor.number("largest_current_A", parameters.largest_current_A, 0.0, 1e3);
}

}  // namespace spoolflow::model
