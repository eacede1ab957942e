#pragma once
/// Anhysteretic field of the solenoid's iron:
///
///     H(B) = B/(mu0 mu_r) + (1/mu0 - 1/(mu0 mu_r)) k(B)
///     k(B) = B + [sqrt((B - Bs)^2 + w^2) - sqrt((B + Bs)^2 + w^2)]/2
///
/// k is odd, near zero below the saturation Bs and runs into B - Bs above it over a hyperbolic knee of width w, so the
/// slope goes from 1/(mu0 mu_r) to 1/mu0: a branch-free curve with a closed integral (the energy density).
#include <numbers>

#include "spoolflow/rig/numerics/parameter.hpp"
#include "spoolflow/rig/numerics/scalar.hpp"

namespace spoolflow::rig {

inline constexpr double vacuum_permeability_H_per_m = 4e-7 * std::numbers::pi;

template <class Scalar>
struct MagneticMaterialOf {
  Scalar relative_permeability = 2000.0;
  Scalar saturation_T = 2.0;
  Scalar knee_width_T = 0.06;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(
        Parameter{"relative_permeability", "1", 200, 10000, "annealed free-cutting or low-carbon steel: 1000 to 4000"},
        self.relative_permeability);
    visit(Parameter{"saturation_T", "T", 1.2, 2.3, "low-carbon steel: 1.9 to 2.1 T at technical saturation"},
          self.saturation_T);
    visit(Parameter{"knee_width_T", "T", 0.02, 0.5,
                    "0.06 T gives 1.8 kA/m at 1.5 T and 3.9 kA/m at 1.8 T, as low-carbon steel tables"},
          self.knee_width_T);
  }
};
using MagneticMaterial = MagneticMaterialOf<double>;

/// The curve's constants.
template <class Scalar>
struct AnhystereticCurveOf {
  Scalar saturation_T, knee_T2;
  Scalar linear_m_per_H;     ///< 1/(mu0 mu_r)
  Scalar saturated_m_per_H;  ///< 1/mu0 - 1/(mu0 mu_r)
};
using AnhystereticCurve = AnhystereticCurveOf<double>;

template <class Scalar = double>
inline AnhystereticCurveOf<Scalar> anhysteretic_curve(const MagneticMaterialOf<Scalar>& iron) {
  const Scalar linear = 1.0 / (vacuum_permeability_H_per_m * iron.relative_permeability);
  return {iron.saturation_T, iron.knee_width_T * iron.knee_width_T, linear, 1.0 / vacuum_permeability_H_per_m - linear};
}

/// A curve's value and slope at one point.
template <class Scalar>
struct FieldPointOf {
  Scalar field_A_per_m;
  Scalar slope_m_per_H;  ///< dH/dB, > 0
};
using FieldPoint = FieldPointOf<double>;

template <class Scalar>
inline FieldPointOf<Scalar> anhysteretic_field(const AnhystereticCurveOf<Scalar>& curve, Scalar flux_density_T) {
  const Scalar below = flux_density_T - curve.saturation_T;
  const Scalar above = flux_density_T + curve.saturation_T;
  const Scalar root_below = square_root(below * below + curve.knee_T2);
  const Scalar root_above = square_root(above * above + curve.knee_T2);
  return {curve.linear_m_per_H * flux_density_T +
              curve.saturated_m_per_H * (flux_density_T + 0.5 * (root_below - root_above)),
          curve.linear_m_per_H + curve.saturated_m_per_H * (1.0 + 0.5 * (below / root_below - above / root_above))};
}

}  // namespace spoolflow::rig
