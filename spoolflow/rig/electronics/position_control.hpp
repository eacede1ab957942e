#pragma once
/// Position control of the spool by one set current for two solenoids: > 0 for b (spool to +x), < 0 for a.
///
///     i = sign(x_set) (i_0 + c |x_set|) + k_p e + integral of k_i e - k_d v,   e = x_set - x
///
/// The feed-forward carries the springs' share; the integrator carries flow force and friction, and that is what makes
/// the spool hunt at rest: it winds up until the spool breaks away, overshoots and sticks on the other side. Inside the
/// dead band about zero the stage is off. Only the solenoid on the side of the set value pulls (`step`), and the
/// springs pull back; or the sign of i chooses (`step_of_both`), and the other solenoid brakes and closes a fast spool.
#include <algorithm>
#include <cmath>

#include "spoolflow/rig/numerics/acquisition.hpp"
#include "spoolflow/rig/numerics/parameter.hpp"

namespace spoolflow::rig {

struct PositionControl {
  double feed_forward_A = 0.5;
  double feed_forward_A_per_m = 300.0;
  double proportional_A_per_m = 1200.0;
  double integral_A_per_m_s = 8000.0;
  double derivative_A_s_per_m = 9.0;
  double derivative_time_s = 3.0e-4;
  double integral_limit_A = 1.5;
  double off_below_m = 2.0e-6;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"feed_forward_A", "A", 0, 5, "lifts the spring's preload"}, self.feed_forward_A);
    visit(Parameter{"feed_forward_A_per_m", "A/m", 0, 5000, "carries the spring's rate"}, self.feed_forward_A_per_m);
    visit(Parameter{"proportional_A_per_m", "A/m", 0, 50000, "1200: 0.12 A for 0.1 mm"}, self.proportional_A_per_m);
    visit(Parameter{"integral_A_per_m_s", "A/(m s)", 0, 2e6, "its ratio to the gain is a time of 20 to 200 ms"},
          self.integral_A_per_m_s);
    visit(Parameter{"derivative_A_s_per_m", "A s/m", 0, 200, "damps the spool on its springs"},
          self.derivative_A_s_per_m);
    visit(Parameter{"derivative_time_s", "s", 1e-4, 0.1, "low pass of the velocity"}, self.derivative_time_s);
    visit(Parameter{"integral_limit_A", "A", 0, 5, "either way"}, self.integral_limit_A);
    visit(Parameter{"off_below_m", "m", 0, 1e-3, "set values this small switch the stage off"}, self.off_below_m);
  }
};

struct PositionControlState {
  double integral_A = 0;
  double lagged_position_m = 0;
  LagMemory lag{};
  bool on = false;
};

/// Set current [A], > 0 for solenoid b; its sign chooses the solenoid.
inline double step_of_both(const PositionControl& control, PositionControlState& state, double set_m, double measured_m,
                           double period_s) {
  const double before_m = state.lagged_position_m;
  state.lagged_position_m = lagged(before_m, measured_m, period_s, control.derivative_time_s, state.lag);
  if (std::abs(set_m) <= control.off_below_m) {
    state.integral_A = 0;
    state.on = false;
    return 0;
  }
  state.on = true;
  const double direction = set_m > 0 ? 1 : -1;
  const double error_m = set_m - measured_m;
  const double velocity_m_per_s = (state.lagged_position_m - before_m) / period_s;
  state.integral_A = std::clamp(state.integral_A + control.integral_A_per_m_s * error_m * period_s,
                                -control.integral_limit_A, control.integral_limit_A);
  const double feed_forward_A = direction * control.feed_forward_A + control.feed_forward_A_per_m * set_m;
  return feed_forward_A + control.proportional_A_per_m * error_m + state.integral_A -
         control.derivative_A_s_per_m * velocity_m_per_s;
}

/// Set current [A], > 0 for solenoid b; only the solenoid on the side of the set value pulls.
inline double step(const PositionControl& control, PositionControlState& state, double set_m, double measured_m,
                   double period_s) {
  const double wanted_A = step_of_both(control, state, set_m, measured_m, period_s);
  if (!state.on) return 0;
  return set_m > 0 ? std::max(wanted_A, 0.0) : std::min(wanted_A, 0.0);
}

}  // namespace spoolflow::rig
