#pragma once
/// Anhysteretic field of the solenoid's iron:
///
///     H(B) = B/(mu0 mu_r) + (1/mu0 - 1/(mu0 mu_r)) k(B)
///     k(B) = B + [sqrt((B - Bs)^2 + w^2) - sqrt((B + Bs)^2 + w^2)]/2
///
/// k is odd, near zero below the saturation Bs and runs into B - Bs above it over a hyperbolic knee of width w, so the
/// slope goes from 1/(mu0 mu_r) to 1/mu0: a branch-free curve with a closed integral (the energy density).
#include <cmath>
#include <numbers>

#include "spoolflow/rig/parameter.hpp"

namespace spoolflow::rig {

inline constexpr double vacuum_permeability_H_per_m = 4e-7 * std::numbers::pi;

struct MagneticMaterial {
  double relative_permeability = 2000.0;
  double saturation_T = 2.0;
  double knee_width_T = 0.10;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(
        Parameter{"relative_permeability", "1", 200, 10000, "annealed free-cutting or low-carbon steel: 1000 to 4000"},
        self.relative_permeability);
    visit(Parameter{"saturation_T", "T", 1.2, 2.3, "low-carbon steel: 1.9 to 2.1 T at technical saturation"},
          self.saturation_T);
    visit(Parameter{"knee_width_T", "T", 0.02, 0.5, "0.1 T gives 4 kA/m at 1.5 T and 9 kA/m at 1.8 T, as steel tables"},
          self.knee_width_T);
  }
};

}  // namespace spoolflow::rig
