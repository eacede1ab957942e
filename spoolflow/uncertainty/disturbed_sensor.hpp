#pragma once
/// The sensor with errors in its inputs and in its model: the measurement function of the uncertainty budget. Errors
/// of maps reach every node of the table, so that the same can be done by hand to a model file.
#include "spoolflow/estimation/running_sensor.hpp"
#include "spoolflow/sensor/condensed.hpp"
#include "spoolflow/sensor/observer.hpp"
#include "spoolflow/uncertainty/input_quantity.hpp"

namespace spoolflow::uncertainty {

template <class T>
using InputErrors = PerQuantity<T>;

/// What the condensed sensor does not know of the place where it works.
struct Surroundings {
  double friction_half_width_N = 0;
  double hysteresis_half_width_N = 0;
  double force_per_current_N_per_A = 1;      ///< of the magnetic-force map
  double force_per_temperature_N_per_K = 0;  ///< of the flow force, at a held pressure difference
  double flow_per_temperature_m3_per_s_K = 0;
  double temperature_per_viscosity_K = 0;  ///< dT/d ln(viscosity), < 0
};

/// Every number of a table through `change`.
template <class T, class Table, class Change>
auto changed(const Table& values, const Change& change) {
  std::array<T, std::tuple_size_v<Table>> out{};
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = change(T(values[k]));
  return out;
}

template <class T>
sensor::Axis<T> as_scalar(const sensor::Axis<double>& axis) {
  return {T(axis.first), T(axis.spacing), T(axis.per_spacing)};
}

/// The condensed sensor's model with errors; the rest is done to its samples. The flow-force map's error of force is
/// taken where it is compared, at the spring: F_mag - F_spr is held against it.
template <class T>
sensor::CondensedParameters<T> disturbed(const sensor::CondensedParameters<double>& valve,
                                         const InputErrors<T>& error) {
  const T magnetic_gain = T(1) + error[InputQuantity::magnetic_load_cell];
  const T axial_gain = T(1) + error[InputQuantity::axial_load_cell];
  const T flow_gain = (T(1) + error[InputQuantity::flow_meter]) * (T(1) - T(0.5) * error[InputQuantity::oil_density]);
  const auto as_it_is = [](const T& value) { return value; };
  const auto& force = valve.magnetic_force;
  const auto& flow = valve.flow_rate;
  return {
      {{as_scalar<T>(force.map.row_axis), as_scalar<T>(force.map.column_axis),
        changed<T>(force.map.values,
                   [&](const T& F) { return magnetic_gain * F + error[InputQuantity::magnetic_force_map]; })},
       {as_scalar<T>(force.hysteresis_half_width_N.axis), changed<T>(force.hysteresis_half_width_N.values, as_it_is)}},
      {{as_scalar<T>(valve.spring.curve.axis), changed<T>(valve.spring.curve.values,
                                                          [&](const T& F) {
                                                            return axial_gain * F + error[InputQuantity::spring] +
                                                                   error[InputQuantity::flow_force_map];
                                                          })}},
      {{as_scalar<T>(flow.largest_force_N.axis),
        changed<T>(flow.largest_force_N.values, [&](const T& F) { return axial_gain * F; })},
       {as_scalar<T>(flow.flow_m3_per_s.row_axis), as_scalar<T>(flow.flow_m3_per_s.column_axis),
        changed<T>(flow.flow_m3_per_s.values,
                   [&](const T& Q) { return flow_gain * Q + error[InputQuantity::flow_map]; })},
       {as_scalar<T>(flow.root_pressure_difference.row_axis), as_scalar<T>(flow.root_pressure_difference.column_axis),
        changed<T>(flow.root_pressure_difference.values, as_it_is)}},
      {as_scalar<T>(valve.friction_half_width_N.axis), changed<T>(valve.friction_half_width_N.values, as_it_is)},
      T(valve.closed_below_m),
      T(valve.force_residual_N),
      T(valve.flow_residual_m3_per_s)};
}

/// A sample as the instruments with their errors give it.
template <class T>
sensor::Sample<T> disturbed(const sensor::Sample<double>& sample, const InputErrors<T>& error) {
  return {T(sample.time_step_s),
          T(sample.current_A) * (T(1) + error[InputQuantity::current_gain]) + error[InputQuantity::current_offset] +
              error[InputQuantity::current_noise] + error[InputQuantity::magnetising_current],
          T(sample.voltage_V) + error[InputQuantity::voltage_offset],
          T(sample.position_m) * (T(1) + error[InputQuantity::position_gain]) + error[InputQuantity::position_zero] +
              error[InputQuantity::position_noise],
          T(sample.oil_temperature_K) + error[InputQuantity::oil_temperature]};
}

/// How much warmer than assumed the oil acts, in temperature and viscosity together.
template <class T>
T warmth_K(const Surroundings& surroundings, const InputErrors<T>& error) {
  return error[InputQuantity::oil_temperature] +
         T(surroundings.temperature_per_viscosity_K) * error[InputQuantity::oil_viscosity];
}

/// The same for the condensed sensor, which also meets the forces that it does not know: they come with a current that
/// balances them.
template <class T>
sensor::Sample<T> disturbed(const sensor::Sample<double>& sample, const Surroundings& surroundings,
                            const InputErrors<T>& error) {
  const T hidden_N = T(surroundings.friction_half_width_N) * error[InputQuantity::friction] +
                     T(surroundings.hysteresis_half_width_N) * error[InputQuantity::magnetic_hysteresis] +
                     T(surroundings.force_per_temperature_N_per_K) * warmth_K(surroundings, error);
  sensor::Sample<T> out = disturbed(sample, error);
  out.current_A = out.current_A + hidden_N / T(surroundings.force_per_current_N_per_A);
  return out;
}

/// As the instruments give it, at its time.
inline estimation::TimedSample at_time(double time_s, const sensor::Sample<double>& read) {
  return {time_s, read.current_A, read.voltage_V, read.position_m, read.oil_temperature_K};
}
inline sensor::Sample<double> without_time(const estimation::TimedSample& sample) {
  return {0, sample.current_A, sample.voltage_V, sample.position_m, sample.oil_temperature_K};
}
inline estimation::TimedSample disturbed(const estimation::TimedSample& sample, const InputErrors<double>& error) {
  return at_time(sample.time_s, disturbed<double>(without_time(sample), error));
}
inline estimation::TimedSample disturbed(const estimation::TimedSample& sample, const Surroundings& surroundings,
                                         const InputErrors<double>& error) {
  return at_time(sample.time_s, disturbed<double>(without_time(sample), surroundings, error));
}

/// What the condensed sensor's answer is to be lessened by: the flow that warmer oil really lets through.
template <class T>
T unseen_flow_m3_per_s(const Surroundings& surroundings, const InputErrors<T>& error) {
  return T(surroundings.flow_per_temperature_m3_per_s_K) * warmth_K(surroundings, error);
}

/// The observer's model with errors. `temperature_per_viscosity_K` as in Surroundings.
[[nodiscard]] sensor::ObserverParameters<double> disturbed(const sensor::ObserverParameters<double>& valve,
                                                           const InputErrors<double>& error,
                                                           double temperature_per_viscosity_K);

}  // namespace spoolflow::uncertainty
