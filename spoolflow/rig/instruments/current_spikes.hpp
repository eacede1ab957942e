#pragma once
/// Single samples of current that are off: a disturbed conversion, a bit lost on the bus. Each sample by chance, alone,
/// up or down.
#include "spoolflow/rig/numerics/parameter.hpp"

namespace spoolflow::rig {

struct CurrentSpikes {
  double share = 0.0;
  double height_A = 1.0;

  bool operator==(const CurrentSpikes&) const = default;
  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"share", "1", 0, 0.1, "of the samples"}, self.share);
    visit(Parameter{"height_A", "A", 0, 20, "either way, on top of the current"}, self.height_A);
  }
};

}  // namespace spoolflow::rig
