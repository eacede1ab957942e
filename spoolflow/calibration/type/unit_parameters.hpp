#pragma once
#include "spoolflow/calibration/type/variation.hpp"
#include "spoolflow/sensor/condensed.hpp"
#include "spoolflow/sensor/observer_parameters.hpp"

namespace spoolflow::calibration {

/// The type's parameters as a unit that deviates so has them, over what the unit's own position sensor and current
/// read. Turns, zero and gain move axes and scale numbers, exactly; permeance and edge position move tables along an
/// axis, linearly between grid points and beyond its ends. No deviation gives the type itself. For deviations of some
/// tolerances: shares above -0.5.
[[nodiscard]] sensor::ObserverParameters<double> unit_parameters(const sensor::ObserverParameters<double>& type,
                                                                 const Deviations& deviations);
/// The same of the condensed sensor. The iron's flux is not known to it: permeance counts by its square in the force.
[[nodiscard]] sensor::CondensedParameters<double> unit_parameters(const sensor::CondensedParameters<double>& type,
                                                                  const Deviations& deviations);

}  // namespace spoolflow::calibration
