#pragma once
/// The ripple that a switched output stage leaves on the coil's current, read by a converter that takes single
/// conversions instead of means over whole switching periods: the ripple aliases to any frequency.
///
///     i_read = i (1 + s/2 tri(f t))        (tri: -1 to 1; s the share peak to peak)
///
/// The force does not follow: iron and eddy currents keep the flux. Switching: 100 Hz to 25 kHz; peak to peak it is
/// U d (1 - d)/(L f), 2 to 15 % of the current below 2 kHz.
#include "spoolflow/rig/numerics/parameter.hpp"

namespace spoolflow::rig {

struct PwmRipple {
  double share = 0.0;
  double frequency_Hz = 2000.0;

  bool operator==(const PwmRipple&) const = default;
  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(
        Parameter{"share", "1", 0, 0.5, "of the current, peak to peak; above 0 the current is one conversion, no mean"},
        self.share);
    visit(Parameter{"frequency_Hz", "Hz", 50, 30000,
                    "of the switching. No clock is another's multiple: 2003 Hz beats at 3 Hz with a recorder of 1 kHz"},
          self.frequency_Hz);
  }
};

}  // namespace spoolflow::rig
