#include "spoolflow/uncertainty/disturbed_sensor.hpp"

namespace spoolflow::uncertainty {

sensor::ObserverParameters<double> disturbed(const sensor::ObserverParameters<double>& valve,
                                             const InputErrors<double>& error, double temperature_per_viscosity_K) {
  sensor::ObserverParameters<double> out = valve;
  const auto change = [](auto& values, double gain, double offset) {
    for (double& value : values) value = gain * value + offset;
  };
  change(out.actuator.magnetic_force.map.values, 1 + error[InputQuantity::magnetic_load_cell],
         error[InputQuantity::magnetic_force_map]);
  change(out.spring.curve.values, 1 + error[InputQuantity::axial_load_cell], error[InputQuantity::spring]);
  change(out.edge.flow_force_N.values, 1 + error[InputQuantity::axial_load_cell], error[InputQuantity::flow_force_map]);
  const double flow_gain = (1 + error[InputQuantity::flow_meter]) * (1 - 0.5 * error[InputQuantity::oil_density]);
  change(out.edge.conductance.values, flow_gain, 0);
  change(out.edge.friction_N.values, 1 + error[InputQuantity::friction], 0);
  change(out.actuator.friction_N.values, 1 + error[InputQuantity::friction], 0);
  // Believed thinner than it is, the oil is read further up the temperature axis.
  out.edge.temperature_K.first -= temperature_per_viscosity_K * error[InputQuantity::oil_viscosity];
  return out;
}

}  // namespace spoolflow::uncertainty
