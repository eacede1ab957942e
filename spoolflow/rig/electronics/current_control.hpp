#pragma once
/// Current control of one solenoid and its PWM output stage, once a period of the electronics.
///
///     u* = R i_set + k_p (i_set - i) + integral of k_i (i_set - i)
///     u  = supply times duty, duty in whole steps of the counter, between -1 (fast decay) and +1
///
/// The stage is a bridge switched once a period; the coil sees its mean over the period. The ripple inside a period is
/// left out: it is far above what coil and iron follow.
#include <algorithm>

#include "spoolflow/rig/numerics/acquisition.hpp"
#include "spoolflow/rig/numerics/parameter.hpp"

namespace spoolflow::rig {

struct CurrentControl {
  double proportional_V_per_A = 100.0;
  double integral_V_per_A_s = 3000.0;
  double feed_forward_ohm = 3.0;
  double supply_V = 24.0;
  double duty_steps = 2000.0;
  double largest_current_A = 2.7;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"proportional_V_per_A", "V/A", 0, 300, "crossover times inductance: 160 Hz at 0.1 H"},
          self.proportional_V_per_A);
    visit(Parameter{"integral_V_per_A_s", "V/(A s)", 0, 20000, "its ratio to the gain is the coil's R/L"},
          self.integral_V_per_A_s);
    visit(Parameter{"feed_forward_ohm", "ohm", 0, 40, "the coil's resistance when warm"}, self.feed_forward_ohm);
    visit(Parameter{"supply_V", "V", 9, 60, "24 V mobile and industrial supply"}, self.supply_V);
    visit(Parameter{"duty_steps", "1", 50, 100000, "counter of the PWM over one polarity"}, self.duty_steps);
    visit(Parameter{"largest_current_A", "A", 0.1, 10, "limit of the set value"}, self.largest_current_A);
  }
};

struct CurrentControlState {
  double integral_V = 0;
};

/// Mean voltage over the coming period [V] for a set current, 0 to the largest; the integrator stops at the rails.
inline double step(const CurrentControl& control, CurrentControlState& state, double set_A, double measured_A,
                   double period_s) {
  const double limited_A = std::clamp(set_A, 0.0, control.largest_current_A);
  const double error_A = limited_A - measured_A;
  const double wanted_V =
      control.feed_forward_ohm * limited_A + control.proportional_V_per_A * error_A + state.integral_V;
  const bool into_rail = std::abs(wanted_V) > control.supply_V && wanted_V * error_A > 0;
  if (!into_rail) {
    state.integral_V += control.integral_V_per_A_s * error_A * period_s;
  }
  const double voltage_V = std::clamp(wanted_V, -control.supply_V, control.supply_V);
  return quantised(voltage_V, control.supply_V / control.duty_steps);
}

}  // namespace spoolflow::rig
