#pragma once
/// A machine that shakes the valve along its spool's axis: the body is left behind by its own inertia.
///
///     a(t) = a_0 g sin(2 pi f t) of the housing towards +x,   F = -m a on spool and armatures, seen from the housing
///
/// ISO 10816 and IEC 60068-2-6 name the levels: mobile machines 5 to 80 Hz, up to 3 g.
#include "spoolflow/rig/numerics/elementary_functions.hpp"
#include "spoolflow/rig/numerics/parameter.hpp"

namespace spoolflow::rig {

struct Vibration {
  double acceleration_g = 0.0;
  double frequency_Hz = 35.0;

  bool operator==(const Vibration&) const = default;
  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"acceleration_g", "9.81 m/s2", 0, 20, "amplitude along the spool's axis; mobile machines to 3"},
          self.acceleration_g);
    visit(Parameter{"frequency_Hz", "Hz", 1, 500, "mobile machines 5 to 80"}, self.frequency_Hz);
  }
};

/// Force on a body of that mass towards +x [N].
inline double vibration_force_N(const Vibration& vibration, double mass_kg, double time_s) {
  if (vibration.acceleration_g == 0) return 0.0;
  constexpr double g_m_per_s2 = 9.80665;
  return -mass_kg * g_m_per_s2 * vibration.acceleration_g * sine_of_turns(vibration.frequency_Hz * time_s);
}

}  // namespace spoolflow::rig
