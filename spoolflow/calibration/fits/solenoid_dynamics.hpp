#pragma once
/// Magnetic hysteresis and eddy currents from current loops, sines and steps at held positions (protocol
/// `solenoid_dynamic`).
#include <vector>

#include "spoolflow/calibration/fits/solenoid_samples.hpp"
#include "spoolflow/calibration/numerics/fit_residual.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/sensor/coil.hpp"
#include "spoolflow/sensor/force_maps.hpp"

namespace spoolflow::calibration {

/// The residual of one part of the protocol.
struct TestResidual {
  int test;
  FitResidual static_map_N;  ///< of the averaged map over the coil current alone
  FitResidual model_N;       ///< with hysteresis and eddy currents
  double model_p95_N;
  double static_map_p95_N;
};

struct SolenoidDynamicsFit {
  sensor::Coil<double> coil;  ///< the given one with hysteresis and eddy currents as fitted
  model::Fit known;           ///< of hysteresis and eddy currents
  std::vector<TestResidual> tests;
  std::vector<model::SolenoidTrace> traces;  ///< of each part at the middle position
  int iterations;
};

/// Runs the sensor itself over the recording and fits hysteresis and eddy currents so that the magnetic force follows
/// the load cell (output error, Gauss-Newton on automatic differentiation, no parameter below zero). The coil's
/// hysteresis and eddy currents are the first guess. `only` restricts the fit to these test numbers (all if empty).
[[nodiscard]] SolenoidDynamicsFit fit_solenoid_dynamics(const SolenoidSamples& samples,
                                                        const sensor::Coil<double>& coil,
                                                        const sensor::MagneticForce<double>& magnetic_force,
                                                        const std::vector<int>& only = {});

}  // namespace spoolflow::calibration
