#pragma once
/// Centring spring of one end: preloaded against its washer, slightly progressive, ageing by relaxation.
///
///     F(s) = (1 - relaxation) (F0 + c s (1 + p s)),   s >= 0 the deflection
///
/// The other end's spring rests on the body then, so the pair's force changes sign over the washers' play at centre.
#include "spoolflow/rig/numerics/parameter.hpp"
#include "spoolflow/rig/numerics/scalar.hpp"

namespace spoolflow::rig {

template <class Scalar>
struct SpringOf {
  Scalar preload_N = 9.0;
  Scalar rate_N_per_m = 12000.0;
  Scalar progressivity_per_m = 15.0;
  Scalar relaxation = 0.0;

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
using Spring = SpringOf<double>;

template <class Scalar>
struct SpringForceOf {
  Scalar force_N;            ///< towards -x
  Scalar stiffness_N_per_m;  ///< dF/dx
};
using SpringForce = SpringForceOf<double>;

/// Both centring springs at spool position x. Over the washers' play w the changeover is x/sqrt(x^2 + w^2).
template <class Scalar>
inline SpringForceOf<Scalar> centring_force(const SpringOf<Scalar>& spring_a, const SpringOf<Scalar>& spring_b,
                                            Scalar washer_play_m, Scalar position_m) {
  const Mask<Scalar> towards_b = position_m >= 0.0;
  const SpringOf<Scalar> spring{
      .preload_N = select(towards_b, spring_b.preload_N, spring_a.preload_N),
      .rate_N_per_m = select(towards_b, spring_b.rate_N_per_m, spring_a.rate_N_per_m),
      .progressivity_per_m = select(towards_b, spring_b.progressivity_per_m, spring_a.progressivity_per_m),
      .relaxation = select(towards_b, spring_b.relaxation, spring_a.relaxation)};
  const Scalar deflection = magnitude(position_m);
  const Scalar root = square_root(position_m * position_m + washer_play_m * washer_play_m);
  const Scalar full =
      (1.0 - spring.relaxation) *
      (spring.preload_N + spring.rate_N_per_m * deflection * (1.0 + spring.progressivity_per_m * deflection));
  const Scalar slope =
      (1.0 - spring.relaxation) * spring.rate_N_per_m * (1.0 + 2.0 * spring.progressivity_per_m * deflection);
  const Scalar share = position_m / root;
  return {full * share, slope * magnitude(share) + full * (1.0 - share * share) / root};
}

}  // namespace spoolflow::rig
