#pragma once
/// Centring spring of one end: preloaded against its washer, slightly progressive, ageing by relaxation.
///
///     F(s) = (1 - relaxation) (F0 + c s (1 + p s)),   s >= 0 the deflection
///
/// The other end's spring rests on the body then, so the pair's force changes sign over the washers' play at centre.
#include "spoolflow/rig/parameter.hpp"

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

}  // namespace spoolflow::rig
