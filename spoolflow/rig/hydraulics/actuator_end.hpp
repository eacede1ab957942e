#pragma once
/// An actuator that stands at its end behind the open valve: it takes no oil, so its port rises to the pressure before
/// the valve within milliseconds and neither flow nor pressure difference is left, whatever the spool does.
///
///     dp <- s dp_set,   tau ds/dt = (0 or 1) - s
///
/// For benches that hold the difference over the valve, which have no actuator of their own; a cylinder with its end
/// cushions is a load (load.hpp). It stands from `begin_s` for `stands_s`, again every `every_s`; or from when the oil
/// that has passed the valve fills its stroke, V = A L, for `stands_s`, after which it is drawn back. tau: a hose of
/// 0.05 L and 1.4 GPa rises by 60 bar within 2 ms at 60 L/min, and later as the flow through the valve fades.
#include <cmath>

#include "spoolflow/rig/numerics/acquisition.hpp"
#include "spoolflow/rig/numerics/parameter.hpp"

namespace spoolflow::rig {

struct ActuatorEnd {
  double stands_s = 0.0;
  double begin_s = 0.0;
  double every_s = 0.0;
  double stroke_m = 0.0;
  double piston_area_m2 = 1.26e-3;
  double settling_s = 0.01;

  bool operator==(const ActuatorEnd&) const = default;
  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"stands_s", "s", 0, 3600, "how long it stands at its end; 0: it never does"}, self.stands_s);
    visit(Parameter{"begin_s", "s", 0, 3600, "when it stands first; unused with a stroke"}, self.begin_s);
    visit(Parameter{"every_s", "s", 0, 3600, "from one standing to the next; 0: once. Unused with a stroke"},
          self.every_s);
    visit(Parameter{"stroke_m", "m", 0, 5, "stands once the oil has moved it so far; 0: by the times alone"},
          self.stroke_m);
    visit(Parameter{"piston_area_m2", "m2", 1e-4, 5e-2, "40 mm piston; only with a stroke"}, self.piston_area_m2);
    visit(Parameter{"settling_s", "s", 1e-3, 1, "time constant of the port's pressure"}, self.settling_s);
  }
};

/// One actuator at work.
class ActuatorAtEnd {
 public:
  explicit ActuatorAtEnd(const ActuatorEnd& end) : end_(end) {}

  /// Share of the pressure difference that is left over the valve in the period of `dt_s` that begins at `time_s`, 0 to
  /// 1, with the flow that the valve has; exactly 1 for an actuator that never stands.
  double share(double time_s, double flow_m3_per_s, double dt_s) {
    if (end_.stands_s == 0) return 1.0;
    share_ = lagged(share_, stands(time_s, flow_m3_per_s, dt_s) ? 0.0 : 1.0, dt_s, end_.settling_s, lag_);
    return share_;
  }

 private:
  bool stands(double time_s, double flow_m3_per_s, double dt_s) {
    if (end_.stroke_m == 0) {
      const double since_s = time_s - end_.begin_s;
      return since_s >= 0 && (end_.every_s > 0 ? std::fmod(since_s, end_.every_s) : since_s) < end_.stands_s;
    }
    if (time_s < until_s_) return true;
    moved_m_ += flow_m3_per_s / end_.piston_area_m2 * dt_s;
    if (moved_m_ < end_.stroke_m) return false;
    moved_m_ = 0;
    until_s_ = time_s + end_.stands_s;
    return true;
  }

  ActuatorEnd end_;
  LagMemory lag_;
  double share_ = 1, moved_m_ = 0, until_s_ = 0;
};

}  // namespace spoolflow::rig
