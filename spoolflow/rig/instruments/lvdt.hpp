#pragma once
/// The valve's position sensor: an LVDT on the armature's push rod, its demodulator, and the acquisition behind it.
///
///     core     = play(position, backlash)
///     signal   = lag((1 + gain) core + linearity range sin(2 pi core/range) + zero(T)),   zero = offset + drift range
///     (T - T_ref) acquired = quantised(signal + noise) + fault
///
/// The valve's own electronics read the signal before the acquisition, hence without its faults: jumps of some percent
/// for some milliseconds as the paper reports at 40 and 70 bar (section 4).
#include <cstdint>

#include "spoolflow/rig/numerics/acquisition.hpp"
#include "spoolflow/rig/numerics/noise.hpp"
#include "spoolflow/rig/numerics/parameter.hpp"

namespace spoolflow::rig {

struct Lvdt {
  double range_m = 2.4e-3;
  double zero_offset_m = -2.5e-6;
  double zero_drift_per_K = 1.5e-4;
  double reference_temperature_C = 30.0;
  double gain_error = 0.0;
  double linearity = 1.0e-3;
  double backlash_m = 1.0e-6;
  double time_constant_s = 1.5e-4;
  double noise_m = 0.7e-6;
  double resolution_m = 0.08e-6;
  double fault_rate_per_s = 0.0;
  double fault_jump = 0.10;
  double fault_duration_s = 0.020;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"range_m", "m", 5e-4, 2e-2, "shares below refer to it: the stroke of one direction"}, self.range_m);
    visit(Parameter{"zero_offset_m", "m", -2e-4, 2e-4, "left over after setting; a set screw turns some micrometres"},
          self.zero_offset_m);
    visit(Parameter{"zero_drift_per_K", "1/K", -1e-3, 1e-3, "data sheets 1e-4 to 2e-4 of the stroke (paper 2.1.2)"},
          self.zero_drift_per_K);
    visit(Parameter{"reference_temperature_C", "degC", -20, 100, "where zero was set"}, self.reference_temperature_C);
    visit(Parameter{"gain_error", "1", -0.1, 0.1, "after setting 0.2 to 1 %"}, self.gain_error);
    visit(Parameter{"linearity", "1", 0, 0.02, "amplitude; data sheets 0.1 to 0.5 % of the stroke"}, self.linearity);
    visit(Parameter{"backlash_m", "m", 0, 1e-4, "half play between push rod and core; of the order of a micrometre"},
          self.backlash_m);
    visit(Parameter{"time_constant_s", "s", 0, 1e-2, "demodulator of a 5 kHz carrier: about 1 kHz"},
          self.time_constant_s);
    visit(Parameter{"noise_m", "m", 0, 1e-4, "standard deviation of one acquired value"}, self.noise_m);
    visit(Parameter{"resolution_m", "m", 0, 1e-4, "16 bit over both directions; 0: none"}, self.resolution_m);
    visit(Parameter{"fault_rate_per_s", "1/s", 0, 10, "acquisition faults; 0: none"}, self.fault_rate_per_s);
    visit(Parameter{"fault_jump", "1", 0, 1, "largest jump, share of the range; sizes are uniform down to half of it"},
          self.fault_jump);
    visit(Parameter{"fault_duration_s", "s", 1e-4, 1, "mean; durations are uniform from a fifth to nine fifths of it"},
          self.fault_duration_s);
  }
};

/// One LVDT at work.
class LvdtReading {
 public:
  LvdtReading(const Lvdt& lvdt, std::uint64_t seed, double position_m, double temperature_C);
  /// The core follows the push rod for `dt_s`.
  void follow(double position_m, double temperature_C, double dt_s);
  /// What the valve's electronics read [m].
  [[nodiscard]] double valve_signal_m();
  /// What the recorder stores at `time_s` [m]; times must not run backwards.
  [[nodiscard]] double acquired_m(double time_s);

 private:
  [[nodiscard]] double undelayed_m(double temperature_C) const;
  [[nodiscard]] double fault_m(double time_s);

  Lvdt lvdt_;
  Noise valve_noise_, recorder_noise_, faults_;
  LagMemory lag_;
  double core_m_;
  double signal_m_;
  double fault_begin_s_;
  double fault_end_s_;
  double jump_m_ = 0;
};

}  // namespace spoolflow::rig
