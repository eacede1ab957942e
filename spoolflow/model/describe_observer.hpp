#pragma once
/// The observer's parameters, each described once; see parameter.hpp.
#include "spoolflow/model/describe_axes.hpp"
#include "spoolflow/model/describe_band.hpp"
#include "spoolflow/model/describe_condensed.hpp"
#include "spoolflow/model/parameter.hpp"
#include "spoolflow/sensor/observer.hpp"

namespace spoolflow::model {

/// What a model may hold as the growth of the magnetising current's uncertainty per eddy current. Where eddy currents
/// are small, what else is wrong in fast changes is many times them.
inline constexpr double largest_eddy_uncertainty = 1e3;

/// As describe_condensed, and visitor.list(Parameter, array).
template <class Coil, class Visitor>
void describe_coil(Coil& coil, Visitor& visitor) {
  visitor.map({.key = "flux_linkage_Wb",
               .unit = "Wb",
               .limits = {-1e3, 1e3},
               .meaning = "flux linkage of the coil",
               .rows = magnetising_current_axis,
               .columns = position_axis,
               .relation = rises_over_rows(1e-4)},
              coil.flux_linkage.map);
  auto& hysteresis = coil.hysteresis;
  visitor.list({.key = "hysteresis_threshold_Wb",
                .unit = "Wb",
                .limits = {1e-9, 1e3},
                .meaning = "flux change at which each stop of the magnetic hysteresis slides",
                .relation = rises},
               hysteresis.threshold);
  visitor.list({"hysteresis_stiffness_A_per_Wb", "A/Wb", {0, 1e6}, "current of each stop without flux"},
               hysteresis.stiffness);
  visitor.list({.key = "hysteresis_stiffness_increase_A_per_Wb",
                .unit = "A/Wb",
                .limits = {-1e6, 1e6},
                .meaning = "increase of that at full flux",
                .relation = sum_not_negative("hysteresis_stiffness_A_per_Wb")},
               hysteresis.stiffness_increase);
  visitor.number({"hysteresis_per_full_flux_1_per_Wb", "1/Wb", {0, 1e6}, "one over the full flux"},
                 hysteresis.per_full_flux);
  auto& eddy_currents = coil.eddy_currents;
  visitor.number(
      {"classical_eddy_current_A_per_V", "A/V", {0, 1e3}, "eddy currents in proportion to the rate of the flux"},
      eddy_currents.classical_A_per_V);
  visitor.number({"excess_eddy_current_A_per_rootV", "A/V(1/2)", {0, 1e3}, "eddy currents with the root of that rate"},
                 eddy_currents.excess_A_per_rootV);
  visitor.number(
      {"smallest_flux_rate_V", "V", {1e-9, 1e3}, "below it the excess eddy currents become proportional, too"},
      eddy_currents.smallest_rate_V);
}

template <class Resistance, class Visitor>
void describe_coil_resistance(Resistance& resistance, Visitor& visitor) {
  visitor.number({"coil_resistance_Ohm",
                  "Ohm",
                  {0, 1e4},
                  "coil resistance as calibrated, where following it begins; 0: not known"},
                 resistance.resistance_Ohm);
  visitor.number({"coil_resistance_uncertainty_Ohm", "Ohm", {0, 1e4}, "one standard deviation of it"},
                 resistance.uncertainty_Ohm);
  visitor.number({"coil_resistance_drift_Ohm_per_root_s",
                  "Ohm/s(1/2)",
                  {0, 1e4},
                  "random walk of the coil's resistance, per root of a second"},
                 resistance.drift_Ohm_per_root_s);
  visitor.number(
      {"voltage_noise_V_root_s", "V s(1/2)", {0, 1e3}, "noise density of the voltage about the coil's equation"},
      resistance.voltage_noise_V_root_s);
}

template <class Actuator, class Visitor>
void describe_actuator(Actuator& actuator, Visitor& visitor) {
  describe_magnetic_force(actuator.magnetic_force, visitor);
  visitor.map({.key = "armature_friction_N",
               .unit = "N",
               .limits = {0, 1e4},
               .meaning = "half-width of the armature's sliding friction",
               .rows = current_axis,
               .columns = position_axis},
              actuator.friction_N);
  describe_coil(actuator.coil, visitor);
  describe_coil_resistance(actuator.coil_resistance, visitor);
  visitor.number({"coercive_current_A", "A", {0, 1e3}, "half width of the coil's widest loop"},
                 actuator.coercive_current_A);
  visitor.number({"per_wiping_flux_1_per_Wb",
                  "1/Wb",
                  {0, 1e9},
                  "one over the flux swing after which older history does not matter"},
                 actuator.per_wiping_flux);
  visitor.number({"magnetic_force_uncertainty_N",
                  "N",
                  {0, 1e4},
                  "one standard deviation of the magnetic force at a known magnetising current"},
                 actuator.force_uncertainty_N);
  visitor.number(
      {"magnetising_current_uncertainty_A", "A", {0, 10}, "one standard deviation of the magnetising current at rest"},
      actuator.current_uncertainty_A);
  visitor.number({"eddy_current_uncertainty", "1", {0, largest_eddy_uncertainty}, "its growth per eddy current"},
                 actuator.eddy_uncertainty);
}

/// Calls visitor.axis(AxisParameter, axis, points) and visitor.volume(TableParameter, volume); the volumes share the
/// axes.
template <class Edge, class Visitor>
void describe_edge(Edge& edge, Visitor& visitor) {
  visitor.axis(oil_temperature_axis, edge.temperature_K, sensor::edge_temperatures);
  visitor.axis(pressure_difference_axis, edge.pressure_difference_Pa, sensor::edge_pressures);
  visitor.axis(position_axis, edge.position_m, sensor::edge_positions);
  visitor.volume({"flow_force_N", "N", {-1e4, 1e4}, "steady flow force, closing > 0"}, edge.flow_force_N);
  visitor.volume({"spool_friction_N", "N", {0, 1e4}, "half width of the spool's friction while it slides"},
                 edge.friction_N);
  visitor.volume({"conductance_m3_per_s_sqrt_Pa",
                  "m3/s/Pa(1/2)",
                  {-1e-3, 1e-2},
                  "flow rate over the root of the pressure difference"},
                 edge.conductance);
}

template <class Sensor, class Visitor>
void describe_position_sensor(Sensor& sensor, Visitor& visitor) {
  visitor.number({"position_noise_m", "m", {0, 1e-3}, "standard deviation of one position sample"}, sensor.noise_m);
  visitor.number({"position_backlash_m", "m", {0, 1e-3}, "half-width of unobserved creep of the spool"},
                 sensor.backlash_m);
  visitor.number(
      {"position_drift_m_per_K", "m/K", {-1e-4, 1e-4}, "drift of the position sensor's zero over oil temperature"},
      sensor.drift_m_per_K);
  visitor.number(
      {"position_drift_free_K", "K", {0, 1e4}, "oil temperature at which the position sensor's zero is right"},
      sensor.drift_free_K);
  visitor.number({"hardest_acceleration_m_per_s2",
                  "m/s2",
                  {1e-3, 1e5},
                  "largest acceleration of the spool; a jump of the position beyond it is a signal fault"},
                 sensor.hardest_acceleration_m_per_s2);
}

template <class Friction, class Visitor>
void describe_friction(Friction& friction, Visitor& visitor) {
  visitor.number(
      {"friction_ageing_ratio", "1", {1, 20}, "the spool's friction after a long rest over its sliding friction"},
      friction.ageing_ratio);
  visitor.number({"friction_ageing_s", "s", {1e-4, 1e4}, "time constant of that growth"}, friction.ageing_s);
  visitor.number({"contact_stiffness_N_per_m", "N/m", {0, 1e10}, "stiffness of the contacts in pre-sliding"},
                 friction.contact_stiffness_N_per_m);
  visitor.number({"friction_tolerance_N",
                  "N",
                  {1e-6, 1e4},
                  "standard deviation of friction at rest about the pre-sliding friction, "
                  "where pressure difference and friction share a force that does not fit"},
                 friction.tolerance_N);
  visitor.number(
      {"breakaway_share", "1", {0, 10}, "standard deviation of the break-away force about ageing, as a share of it"},
      friction.breakaway_share);
  visitor.number({"operation_friction_ratio",
                  "1",
                  {sensor::least_friction_ratio, sensor::most_friction_ratio},
                  "friction in operation over half the width of the bench's loops, to begin with"},
                 friction.operation_ratio);
  visitor.number(
      {.key = "freeing_share",
       .unit = "1",
       .limits = {0.5, 10},
       .meaning = "dither frees the spool where half the swing of friction is so many times sliding friction",
       .otherwise = 1.2},
      friction.freeing_share);
}

template <class Pressure, class Visitor>
void describe_pressure(Pressure& pressure, Visitor& visitor) {
  visitor.number({"sliding_drift_Pa_per_sqrt_s",
                  "Pa/s(1/2)",
                  {0, 1e9},
                  "random walk of the pressure difference while the spool slides"},
                 pressure.sliding_drift_Pa_per_sqrt_s);
  visitor.number({"resting_drift_Pa_per_sqrt_s",
                  "Pa/s(1/2)",
                  {0, 1e9},
                  "random walk of the pressure difference while the spool rests"},
                 pressure.resting_drift_Pa_per_sqrt_s);
  visitor.number({.key = "least_process_noise",
                  .unit = "1",
                  .limits = {1e-12, 1},
                  .meaning = "process noise where the supply has proved steady, as a share of that walk's variance",
                  .relation = not_above("first_process_noise")},
                 pressure.least_process_noise);
  visitor.number({"first_process_noise",
                  "1",
                  {1e-6, 1},
                  "process noise of a supply of which nothing is known yet, as a share of that walk's variance"},
                 pressure.first_process_noise);
  visitor.number({"force_correlation_s", "s", {1e-6, 10}, "correlation time of the errors of the forces"},
                 pressure.force_correlation_s);
  visitor.number({"friction_ratio_deviation", "1", {1e-3, 2}, "standard deviation of the friction ratio at any time"},
                 pressure.ratio_deviation);
  visitor.number({"friction_ratio_memory_s",
                  "s",
                  {1e-3, 1e6},
                  "time constant of sliding with which the friction ratio returns to the calibrated one"},
                 pressure.ratio_memory_s);
  visitor.number({"constrained_correction_s",
                  "s",
                  {1e-5, 1e3},
                  "time constant of the constrained correction of the pressure difference by a force that "
                  "friction at rest cannot explain"},
                 pressure.constrained_correction_s);
}

template <class Inlet, class Visitor>
void describe_inlet_share(Inlet& inlet, Visitor& visitor) {
  visitor.number({.key = "inlet_pressure_share",
                  .unit = "1",
                  .limits = {0.02, 0.98},
                  .meaning = "share of the path's pressure difference that lies over its inlet edge, P to B or P to A, "
                             "under the calibrated load",
                  .otherwise = 0.5},
                 inlet.share);
  visitor.number({.key = "inlet_pressure_share_range",
                  .unit = "1",
                  .limits = {0, 0.5},
                  .meaning = "largest difference from it by measured port pressures",
                  .otherwise = 0.25},
                 inlet.range);
}

/// Calls visitor for every parameter as describe_condensed, describe_coil and describe_edge say.
template <class Parameters, class Visitor>
void describe_observer(Parameters& parameters, Visitor&& visitor) {
  describe_actuator(parameters.actuator, visitor);
  describe_spring(parameters.spring, visitor);
  describe_edge(parameters.edge, visitor);
  describe_position_sensor(parameters.position_sensor, visitor);
  describe_friction(parameters.friction, visitor);
  describe_pressure(parameters.pressure, visitor);
  describe_band(parameters.band, visitor);
  describe_inlet_share(parameters.inlet, visitor);
  visitor.number({.key = "unsettled_load_share",
                  .unit = "1",
                  .limits = {0, 10},
                  .meaning = "half the width that a whole valve's flow takes in the band to which its load has not "
                             "settled, over the change still to settle; 0 behind loads of equal flows",
                  .otherwise = 0},
                 parameters.unsettled_load_share);
  visitor.number({.key = "moving_mass_kg",
                  .unit = "kg",
                  .limits = {1e-3, 100},
                  .meaning = "spool, push rod and armature together",
                  .otherwise = 0.11},
                 parameters.moving_mass_kg);
  visitor.number({"closed_below_m", "m", {-1e-3, 0.1}, "positions below this count as closed"},
                 parameters.closed_below_m);
  visitor.number({.key = "stopped_above_m",
                  .unit = "m",
                  .limits = {0, 2 * sensor::no_open_stop_m},
                  .meaning = "positions above this count as on the open stop; about 1: none is known",
                  .otherwise = sensor::no_open_stop_m},
                 parameters.stopped_above_m);
  visitor.number({"largest_current_A", "A", {0, 1e3}, "currents above this count as saturated"},
                 parameters.largest_current_A);
  visitor.number({.key = "largest_voltage_V",
                  .unit = "V",
                  .limits = {0, 1e5},
                  .meaning = "of the coil, either way, in the calibration's recordings; 0: not known",
                  .otherwise = 0.0},
                 parameters.largest_voltage_V);
  describe_current_limits(parameters.current_limits, visitor);
  describe_environment(parameters.environment, visitor);
}

}  // namespace spoolflow::model
