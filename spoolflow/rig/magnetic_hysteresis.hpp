#pragma once
/// Static hysteresis of the iron: a field of parallel stop elements (Prandtl) on top of the anhysteretic curve.
///
///     H = H_an(B) + sum_k h_k,   h_k <- clamp(h_k + s_k dB, -kappa_k, +kappa_k)
///
/// Each element is an elastic, perfectly plastic spring between B and H: it stores h_k^2/(2 s_k) and dissipates
/// kappa_k |dB| while it yields, so the operator is thermodynamically consistent, every minor loop closes, and the
/// enclosed area is the loss. It is the stop form of the energy-based play model (Bergqvist 1997; Francois-Lavet,
/// Henrotte et al. 2013), written for flux as input. Rate-independent; leaves out the narrowing of loops in saturation.
#include <array>

#include "spoolflow/rig/parameter.hpp"

namespace spoolflow::rig {

struct MagneticHysteresis {
  double coercive_field_A_per_m = 110.0;
  double reversal_width_T = 0.30;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"coercive_field_A_per_m", "A/m", 0, 600, "annealed low-carbon steel 60 to 200; 0 is lossless iron"},
          self.coercive_field_A_per_m);
    visit(Parameter{"reversal_width_T", "T", 0.02, 1.0, "flux change that brings the last element to yield"},
          self.reversal_width_T);
  }
};

inline constexpr std::size_t hysteresis_elements = 5;
/// Field of each stop element [A/m].
using HysteresisState = std::array<double, hysteresis_elements>;

}  // namespace spoolflow::rig
