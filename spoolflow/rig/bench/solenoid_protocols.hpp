#pragma once
/// The solenoid bench (paper section 3, Figs 6 to 8): solenoid b in a frame, a carriage moves or holds its armature
/// against a load cell while an amplifier feeds the coil.
#include <vector>

#include "spoolflow/rig/bench/bench_run.hpp"
#include "spoolflow/rig/numerics/parameter.hpp"

namespace spoolflow::rig {

/// What the bench must know of the solenoid.
struct SolenoidRating {
  double rated_current_A = 2.6;
  double rated_voltage_V = 7.8;  ///< rated current through the warm coil
  double stroke_m = 2.4e-3;
};

/// The carriage moves the armature quasi-statically to and fro at each held current.
struct SolenoidForceMapProtocol {
  double current_levels = 13.0;
  double current_rate_percent_per_s = 12.8;
  double carriage_percent_per_s = 20.8;
  double travel_percent = 103.5;
  double hold_s = 0.3;
  double dither_percent = 0.0;
  double dither_frequency_Hz = 160.0;
  double ambient_temperature_C = 25.0;
  double sample_rate_Hz = 200.0;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"current_levels", "1", 2, 100, "equal steps up to the rated current"}, self.current_levels);
    visit(Parameter{"current_rate_percent_per_s", "%/s", 0.5, 200, "of the rated current, between levels"},
          self.current_rate_percent_per_s);
    visit(Parameter{"carriage_percent_per_s", "%/s", 0.5, 200, "of the stroke; quasi-static"},
          self.carriage_percent_per_s);
    visit(Parameter{"travel_percent", "%", 10, 104, "of the stroke, short of the pole"}, self.travel_percent);
    visit(Parameter{"hold_s", "s", 0, 60, "at the far end"}, self.hold_s);
    visit(Parameter{"dither_percent", "%", 0, 40, "amplitude on the held current, of the rated current; 0: none"},
          self.dither_percent);
    visit(Parameter{"dither_frequency_Hz", "Hz", 20, 500, "as the valve's electronics"}, self.dither_frequency_Hz);
    visit(Parameter{"ambient_temperature_C", "degC", -20, 60, "of the laboratory"}, self.ambient_temperature_C);
    visit(Parameter{"sample_rate_Hz", "Hz", 10, 10000, "of the recorder; a divisor of 10 kHz"}, self.sample_rate_Hz);
  }
};
[[nodiscard]] BenchRun plan(const SolenoidForceMapProtocol& protocol, const SolenoidRating& rating);

/// Six tests at each held position, separated by the column `test`: 1 slow major current loop, 2 loops to lower peaks,
/// 3 shrinking minor loops, 4 current sines of growing frequency, 5 voltage steps, 6 demagnetising ramp.
struct SolenoidDynamicProtocol {
  std::vector<double> positions_percent{12.5, 50, 87.5};
  double major_loop_percent = 92.0;
  double bias_percent = 46.0;
  double minor_loop_percent = 23.0;
  double sine_percent = 14.0;
  std::vector<double> sine_frequencies_Hz{5, 20, 60, 150};
  double upper_voltage_percent = 51.0;
  double lower_voltage_percent = 19.0;
  double ambient_temperature_C = 25.0;
  double slow_rate_Hz = 200.0;
  double dither_percent = 0.0;
  double dither_frequency_Hz = 160.0;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"positions_percent", "%", 0, 103, "of the stroke"}, self.positions_percent);
    visit(Parameter{"major_loop_percent", "%", 10, 100, "peak of test 1, of the rated current"},
          self.major_loop_percent);
    visit(Parameter{"bias_percent", "%", 5, 60, "mean of tests 3 and 4, start of test 6, of the rated current"},
          self.bias_percent);
    visit(Parameter{"minor_loop_percent", "%", 1, 30, "first amplitude of test 3"}, self.minor_loop_percent);
    visit(Parameter{"sine_percent", "%", 1, 30, "amplitude of test 4"}, self.sine_percent);
    visit(Parameter{"sine_frequencies_Hz", "Hz", 1, 400, "of test 4, each for ten cycles, at least 0.4 s"},
          self.sine_frequencies_Hz);
    visit(Parameter{"upper_voltage_percent", "%", 5, 100, "of test 5, of rated current times warm resistance"},
          self.upper_voltage_percent);
    visit(Parameter{"lower_voltage_percent", "%", 0, 100, "of test 5"}, self.lower_voltage_percent);
    visit(Parameter{"slow_rate_Hz", "Hz", 10, 10000, "of the recorder in tests 1, 2, 3, 6; a divisor of 10 kHz"},
          self.slow_rate_Hz);
    visit(Parameter{"dither_percent", "%", 0, 40, "amplitude on set currents, of the rated current; 0: none"},
          self.dither_percent);
    visit(Parameter{"dither_frequency_Hz", "Hz", 20, 500, "as the valve's electronics"}, self.dither_frequency_Hz);
    visit(Parameter{"ambient_temperature_C", "degC", -20, 60, "of the laboratory"}, self.ambient_temperature_C);
  }
};
[[nodiscard]] BenchRun plan(const SolenoidDynamicProtocol& protocol, const SolenoidRating& rating);

}  // namespace spoolflow::rig
