#pragma once
/// The force that the sensor's coil predicts against the load cell, with its derivatives.
#include <array>
#include <map>
#include <vector>

#include <Eigen/Core>

#include "spoolflow/calibration/fits/solenoid_samples.hpp"
#include "spoolflow/calibration/numerics/fit_residual.hpp"
#include "spoolflow/sensor/coil.hpp"
#include "spoolflow/sensor/force_maps.hpp"

namespace spoolflow::calibration {

/// What is fitted of a coil, each >= 0: the largest outputs [A] of the hysteresis's stops without flux and at full
/// flux, the classical [A/V] and the excess [A/V^0.5] eddy currents.
inline constexpr int coil_unknowns = 2 * sensor::hysteresis_elements + 2;
using CoilUnknowns = std::array<double, coil_unknowns>;

/// A cubic over current corrects the force map at each held position, which it meets within its own uncertainty only.
inline constexpr int map_corrections = 4;

/// One stretch of a recording with the armature held: samples [begin, end).
struct HeldArmature {
  std::size_t begin;
  std::size_t end;
  double position_m;
};
[[nodiscard]] std::vector<HeldArmature> held_armature(const SolenoidSamples& samples);

struct CoilTask {
  const SolenoidSamples& samples;
  const sensor::Coil<double>& coil;  ///< flux linkage and thresholds, which stay
  const sensor::MagneticForce<double>& magnetic_force;
  std::vector<HeldArmature> held;
  std::vector<double> weight;  ///< of each sample's residual; 0: left out
};

/// The coil with these unknowns.
[[nodiscard]] sensor::Coil<double> coil_with(const CoilTask& task, const CoilUnknowns& unknowns);

/// Sum of squares of the weighted force deviations [N2], half of it differentiated once and twice (Gauss-Newton) by the
/// unknowns and then by the corrections of all held positions.
struct CoilDeviation {
  double sum_of_squares = 0;
  Eigen::VectorXd gradient;
  Eigen::MatrixXd curvature;
  std::map<int, FitResidual> parts;  ///< deviations [N] of each part of the protocol, all counted samples alike
};

/// Runs the sensor's own coil along all samples with automatic differentiation; held positions side by side.
[[nodiscard]] CoilDeviation coil_deviation(const CoilTask& task, const CoilUnknowns& unknowns,
                                           const Eigen::VectorXd& corrections_N);

}  // namespace spoolflow::calibration
