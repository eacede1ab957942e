#pragma once
#include "spoolflow/sensor/table.hpp"

namespace spoolflow::sensor {

inline constexpr int flux_map_currents = 21;
inline constexpr int flux_map_positions = 9;
inline constexpr int flux_map_currents_below_zero = 2;  ///< remanence leaves small negative magnetising currents

/// Flux linkage of the coil [Wb] over magnetising current [A] (rows; hysteresis and eddy currents taken off the coil
/// current) and spool position [m] (columns). Zero without magnetising current, rising with it. From the coil voltage
/// on the solenoid rig; paper section 2.2.
template <class T>
struct FluxLinkage {
  Map<T, flux_map_currents, flux_map_positions> map;
};

}  // namespace spoolflow::sensor
