#pragma once
/// What the data sheet of an oil says of other temperatures.
#include "spoolflow/model/model.hpp"

namespace spoolflow::model {

/// Kinematic viscosity [m2/s] by Walther's equation through both values of the data sheet; those of HLP 46 stand in
/// where they are absent or viscosity would not fall. `oil_temperature_K` > 0.
[[nodiscard]] double viscosity_m2_per_s(const Fluid& fluid, double oil_temperature_K);

/// A mineral oil's density falls by this share a kelvin [1/K]; 6.5e-4 to 7.5e-4.
inline constexpr double thermal_expansion_per_K = 7e-4;

}  // namespace spoolflow::model
