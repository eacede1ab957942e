#pragma once
/// The magnetising current of a solenoid's recordings: what they determine of it before hysteresis and eddy currents
/// are known, and what a coil makes of it.
#include <vector>

#include "spoolflow/calibration/fits/solenoid_samples.hpp"
#include "spoolflow/sensor/coil.hpp"
#include "spoolflow/sensor/force_maps.hpp"

namespace spoolflow::calibration {

/// Samples with the magnetising current [A] at each sample's instant; NaN where it is not known. Flux changes are taken
/// over some samples each; with `longest_window_s` > 0 over up to twice that, from quiet current to quiet current.
struct FluxEvidence {
  const SolenoidSamples* samples;
  std::vector<double> magnetising_current_A;
  double longest_window_s = 0;
};

/// While the armature is held, the load cell gives the magnetising current at any speed: the averaged force map
/// inverted at that position. Not known where the force is too small.
[[nodiscard]] FluxEvidence evidence_from_force(const SolenoidSamples& samples,
                                               const sensor::MagneticForce<double>& magnetic_force);

/// While everything moves slowly, the coil current is the magnetising current but for the static hysteresis, which
/// strokes both ways average out.
[[nodiscard]] FluxEvidence evidence_from_current(const SolenoidSamples& samples);

/// What the coil's hysteresis and eddy currents leave of the current of each sample [A].
[[nodiscard]] std::vector<double> magnetising_currents_A(const SolenoidSamples& samples,
                                                         const sensor::Coil<double>& coil);

}  // namespace spoolflow::calibration
