#pragma once
/// What feeds port P and what port T drains to.
///
/// Pressure supply (loads orifice and cylinder): C_P dp_P/dt = G (p_set + ripple - p_P) - Q_PA - Q_PB.
/// Held difference (load held_difference): the bench's controller moves p_P so that the difference over the edge that
/// the spool opens (P to B for x >= 0, P to A below) follows its set value with a natural frequency and a source
/// stiffness,
///
///     C_P dp_P/dt = G (p_set - p_P) + Q_i - Q_PA - Q_PB,   dQ_i/dt = G/T (p_set - p_P)
///
/// or follows at once when `ideal` is asked for. Ripple is a parabolic wave at the pump's piston frequency.
#include "spoolflow/rig/numerics/elementary_functions.hpp"
#include "spoolflow/rig/numerics/parameter.hpp"
#include "spoolflow/rig/numerics/scalar.hpp"

namespace spoolflow::rig {

/// Ripple of a machine's pump on the pressure before the valve: one line at the pistons' frequency, one below it from
/// an unequal piston or the shaft.
///
///     p_ripple(t) = a_1 sin(2 pi f_1 t) + a_2 sin(2 pi f_2 t)
///
/// It frees spool and armature as dither does and leaves no trace in the current. Comes on top of the bench's own.
/// Piston pumps: Ivantysyn and Ivantysynova, Hydrostatic Pumps and Motors, 2001.
struct PumpRipple {
  double amplitude_bar = 0.0;
  double frequency_Hz = 225.0;
  double second_amplitude_bar = 0.0;
  double second_frequency_Hz = 25.0;

  bool operator==(const PumpRipple&) const = default;
  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"amplitude_bar", "bar", 0, 20, "half of peak to peak; 0.5 to 4 % of the pressure"},
          self.amplitude_bar);
    visit(Parameter{"frequency_Hz", "Hz", 1, 2000, "pistons times speed: 9 at 1500 rev/min"}, self.frequency_Hz);
    visit(Parameter{"second_amplitude_bar", "bar", 0, 20, "half of peak to peak of the second line"},
          self.second_amplitude_bar);
    visit(Parameter{"second_frequency_Hz", "Hz", 1, 2000, "the shaft's turns: 25 at 1500 rev/min"},
          self.second_frequency_Hz);
  }
};

/// What the pump adds to the source's pressure [Pa].
inline double pump_ripple_Pa(const PumpRipple& ripple, double time_s) {
  if (ripple.amplitude_bar == 0 && ripple.second_amplitude_bar == 0) return 0.0;
  constexpr double Pa_per_bar = 1e5;
  return Pa_per_bar * (ripple.amplitude_bar * sine_of_turns(ripple.frequency_Hz * time_s) +
                       ripple.second_amplitude_bar * sine_of_turns(ripple.second_frequency_Hz * time_s));
}

template <class Scalar>
struct SupplyOf {
  Scalar line_volume_m3 = 2.0e-4;
  Scalar source_conductance_m3_per_s_Pa = 2.0e-9;
  Scalar hold_integral_time_s = 0.02;
  Scalar ripple_Pa = 0.4e5;
  Scalar ripple_Hz = 225.0;
  Scalar tank_pressure_Pa = 1.0e5;
  Scalar back_pressure_Pa = 4.0e5;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"line_volume_m3", "m3", 1e-5, 2e-2, "hose and block between source and valve"},
          self.line_volume_m3);
    visit(Parameter{"source_conductance_m3_per_s_Pa", "m3/(s Pa)", 1e-11, 1e-7,
                    "flow per control error; 2e-9 falls by 6 bar at 80 L/min"},
          self.source_conductance_m3_per_s_Pa);
    visit(Parameter{"hold_integral_time_s", "s", 1e-3, 10, "of the bench's pressure controller"},
          self.hold_integral_time_s);
    visit(Parameter{"ripple_Pa", "Pa", 0, 20e5, "amplitude; pumps 0.5 to 3 % of pressure"}, self.ripple_Pa);
    visit(Parameter{"ripple_Hz", "Hz", 1, 2000, "9 pistons at 1500 rev/min"}, self.ripple_Hz);
    visit(Parameter{"tank_pressure_Pa", "Pa", 0, 50e5, "gauge; return filter and line"}, self.tank_pressure_Pa);
    visit(Parameter{"back_pressure_Pa", "Pa", 0, 100e5, "gauge, behind the measured edge on the bench (flow meter)"},
          self.back_pressure_Pa);
  }
};
using Supply = SupplyOf<double>;

}  // namespace spoolflow::rig
