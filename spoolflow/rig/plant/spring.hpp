#pragma once
/// Centring spring of one end: preloaded against its washer, slightly progressive, ageing by relaxation.
///
///     F(s) = (1 - relaxation) (F0 + c s (1 + p s)),   s >= 0 the deflection
///
/// The other end's spring rests on the body then, so the pair's force changes sign over the washers' play at centre.
#include <cmath>

#include "spoolflow/rig/numerics/parameter.hpp"

namespace spoolflow::rig {

struct Spring {
  double preload_N = 9.0;
  double rate_N_per_m = 12000.0;
  double progressivity_per_m = 15.0;
  double relaxation = 0.0;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"preload_N", "N", 0, 100, "centres the spool against friction; about 3 times break-away"},
          self.preload_N);
    visit(
        Parameter{"rate_N_per_m", "N/m", 1000, 80000, "preload plus stroke leaves the magnet half its force for flow"},
        self.rate_N_per_m);
    visit(Parameter{"progressivity_per_m", "1/m", 0, 100, "coils closing up: some per cent over the stroke"},
          self.progressivity_per_m);
    visit(Parameter{"relaxation", "1", 0, 0.5, "fault: share of force lost by ageing; 0 is new"}, self.relaxation);
  }
};

struct SpringForce {
  double force_N;            ///< towards -x
  double stiffness_N_per_m;  ///< dF/dx
};

/// Both centring springs at spool position x. Over the washers' play w the changeover is x/sqrt(x^2 + w^2).
inline SpringForce centring_force(const Spring& spring_a, const Spring& spring_b, double washer_play_m,
                                  double position_m) {
  const Spring& spring = position_m >= 0.0 ? spring_b : spring_a;
  const double deflection = std::abs(position_m);
  const double root = std::sqrt(position_m * position_m + washer_play_m * washer_play_m);
  const double full =
      (1.0 - spring.relaxation) *
      (spring.preload_N + spring.rate_N_per_m * deflection * (1.0 + spring.progressivity_per_m * deflection));
  const double slope =
      (1.0 - spring.relaxation) * spring.rate_N_per_m * (1.0 + 2.0 * spring.progressivity_per_m * deflection);
  const double share = position_m / root;
  return {full * share, slope * std::abs(share) + full * (1.0 - share * share) / root};
}

}  // namespace spoolflow::rig
