#pragma once
/// The shape and the size of the magnetic force from the coil's flux linkage.
#include "spoolflow/sensor/coil.hpp"
#include "spoolflow/sensor/force_maps.hpp"

namespace spoolflow::calibration {

/// F(i, x) = dW/dx, W(i, x) = integral of the flux linkage over the current from 0 to i at constant x (coenergy). Over
/// position the coenergy is taken as a polynomial of fourth order, over current the flux linkage as linear between its
/// nodes. Omits what hysteresis and eddy currents store and waste: the linkage is over magnetising current.
[[nodiscard]] sensor::MagneticForce<double> force_of_coenergy(const sensor::FluxLinkage<double>& flux_linkage);

/// A force map without force over 0 to `largest_A` and the stroke: the axes for fits.
[[nodiscard]] sensor::MagneticForce<double> empty_force_map(double largest_A, double stroke_m);

}  // namespace spoolflow::calibration
