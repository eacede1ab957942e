#pragma once
/// Operation of the whole, position-controlled valve on the bench (paper section 4).
#include <cstdint>
#include <vector>

#include "spoolflow/rig/bench/bench_run.hpp"
#include "spoolflow/rig/numerics/parameter.hpp"

namespace spoolflow::rig {

/// What every operating run shares.
struct OperationConditions {
  double oil_temperature_start_C = 50.0;
  double oil_temperature_end_C = 50.0;
  double supply_pressure_bar = 100.0;
  double position_faults_per_s = 0.0;
  double sample_rate_Hz = 1000.0;
  bool supply_follows_difference = false;  ///< loads orifice, cylinder and motor: the pressure differences are the
                                           ///< supply's, above tank
  bool port_pressures = false;             ///< the pressures of ports P, A, B and T are recorded as well

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"oil_temperature_start_C", "degC", -20, 100, "moves linearly over the run"},
          self.oil_temperature_start_C);
    visit(Parameter{"oil_temperature_end_C", "degC", -20, 100, "as at the start: constant"},
          self.oil_temperature_end_C);
    visit(Parameter{"supply_pressure_bar", "bar", 1, 350,
                    "of loads orifice, cylinder and motor; unused where the pressure "
                    "difference is held"},
          self.supply_pressure_bar);
    visit(Parameter{"position_faults_per_s", "1/s", 0, 10,
                    "acquisition faults of the position signal (paper, 40 and "
                    "70 bar)"},
          self.position_faults_per_s);
    visit(Parameter{"sample_rate_Hz", "Hz", 10, 10000, "of the recorder; a divisor of 10 kHz"}, self.sample_rate_Hz);
  }
};

/// Triangles with holds, one for each pressure difference (paper, Figs 9 and 10); with another end temperature it is
/// the temperature sweep, with dither the dither run.
struct RampsProtocol {
  OperationConditions conditions;
  std::vector<double> pressure_differences_bar{60};
  double rate_percent_per_s = 5.0;
  double peak_percent = 100.0;
  double second_peak_percent = 0.0;
  double hold_s = 5.0;
  double pause_s = 1.0;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit("conditions", self.conditions);
    visit(Parameter{"pressure_differences_bar", "bar", 0, 350, "one triangle each"}, self.pressure_differences_bar);
    visit(Parameter{"rate_percent_per_s", "%/s", 0.1, 10000, "of the set position; 5 %/s in the paper"},
          self.rate_percent_per_s);
    visit(Parameter{"peak_percent", "%", -100, 100, "of the stroke; negative opens P to A"}, self.peak_percent);
    visit(Parameter{"second_peak_percent", "%", -100, 100,
                    "of a second triangle at each pressure difference, as to the other side; 0: none"},
          self.second_peak_percent);
    visit(Parameter{"hold_s", "s", 0, 600, "at the peak"}, self.hold_s);
    visit(Parameter{"pause_s", "s", 0, 600, "closed, before and after each triangle"}, self.pause_s);
  }
};
[[nodiscard]] BenchRun plan(const RampsProtocol& protocol);

/// Set positions one after the other, each reached at a rate or at once.
struct StepsProtocol {
  OperationConditions conditions;
  std::vector<double> positions_percent{25, 75, 50, 100, 0};
  double rate_percent_per_s = 1.0e6;
  double hold_s = 1.0;
  double pressure_difference_bar = 60.0;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit("conditions", self.conditions);
    visit(Parameter{"positions_percent", "%", -100, 100, "of the stroke, in turn"}, self.positions_percent);
    visit(Parameter{"rate_percent_per_s", "%/s", 0.1, 1e6, "1e6: a step within one period"}, self.rate_percent_per_s);
    visit(Parameter{"hold_s", "s", 0.001, 600, "at each"}, self.hold_s);
    visit(Parameter{"pressure_difference_bar", "bar", 0, 350, "held"}, self.pressure_difference_bar);
  }
};
[[nodiscard]] BenchRun plan(const StepsProtocol& protocol);

/// A sine on the set position; a sweep where the frequencies differ.
struct SineProtocol {
  OperationConditions conditions;
  double centre_percent = 55.0;
  double amplitude_percent = 15.0;
  double frequency_start_Hz = 0.1;
  double frequency_end_Hz = 20.0;
  double sweep_s = 55.0;
  double pressure_difference_bar = 60.0;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit("conditions", self.conditions);
    visit(Parameter{"centre_percent", "%", -100, 100, "of the stroke"}, self.centre_percent);
    visit(Parameter{"amplitude_percent", "%", 0, 100, "of the stroke"}, self.amplitude_percent);
    visit(Parameter{"frequency_start_Hz", "Hz", 0.01, 500, "grows by equal time an octave"}, self.frequency_start_Hz);
    visit(Parameter{"frequency_end_Hz", "Hz", 0.01, 500, "as at the start: a plain sine"}, self.frequency_end_Hz);
    visit(Parameter{"sweep_s", "s", 0.01, 3600, "after 2.5 s of approach and rest"}, self.sweep_s);
    visit(Parameter{"pressure_difference_bar", "bar", 0, 350, "held"}, self.pressure_difference_bar);
  }
};
[[nodiscard]] BenchRun plan(const SineProtocol& protocol);

/// Random ramps and holds of the position, random steps of the pressure difference, and of the cylinder's load.
struct DutyCycleProtocol {
  OperationConditions conditions;
  double duration_s = 180.0;
  double lowest_percent = 10.0;
  double highest_percent = 100.0;
  double slowest_percent_per_s = 15.0;
  double fastest_percent_per_s = 180.0;
  double longest_hold_s = 3.0;
  double lowest_pressure_bar = 8.0;
  double highest_pressure_bar = 70.0;
  double longest_pressure_hold_s = 6.0;
  double lowest_load_N = 0.0;
  double highest_load_N = 0.0;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit("conditions", self.conditions);
    visit(Parameter{"duration_s", "s", 0.1, 3600, "of the whole run"}, self.duration_s);
    visit(Parameter{"lowest_percent", "%", -100, 100, "set positions are uniform between"}, self.lowest_percent);
    visit(Parameter{"highest_percent", "%", -100, 100, "set positions are uniform between"}, self.highest_percent);
    visit(Parameter{"slowest_percent_per_s", "%/s", 0.5, 10000, "rates are uniform in their logarithm"},
          self.slowest_percent_per_s);
    visit(Parameter{"fastest_percent_per_s", "%/s", 0.5, 10000, "rates are uniform in their logarithm"},
          self.fastest_percent_per_s);
    visit(Parameter{"longest_hold_s", "s", 0, 600, "holds are uniform from 0.1 s"}, self.longest_hold_s);
    visit(Parameter{"lowest_pressure_bar", "bar", 0, 350, "levels are uniform between"}, self.lowest_pressure_bar);
    visit(Parameter{"highest_pressure_bar", "bar", 0, 350, "levels are uniform between"}, self.highest_pressure_bar);
    visit(Parameter{"longest_pressure_hold_s", "s", 0.1, 600, "holds are uniform from a tenth of it"},
          self.longest_pressure_hold_s);
    visit(Parameter{"lowest_load_N", "N", -1e6, 1e6,
                    "force on the cylinder against moving out; levels are uniform between, held as the pressures"},
          self.lowest_load_N);
    visit(Parameter{"highest_load_N", "N", -1e6, 1e6, "levels are uniform between"}, self.highest_load_N);
  }
};
[[nodiscard]] BenchRun plan(const DutyCycleProtocol& protocol, std::uint64_t seed);

/// Steps of the pressure difference while the spool rests at each position.
struct PressureStepsProtocol {
  OperationConditions conditions;
  std::vector<double> positions_percent{40, 70, 100};
  std::vector<double> pressure_differences_bar{20, 60, 30, 70, 50, 10, 40};
  double hold_s = 3.0;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit("conditions", self.conditions);
    visit(Parameter{"positions_percent", "%", -100, 100, "of the stroke, approached at 50 %/s"},
          self.positions_percent);
    visit(Parameter{"pressure_differences_bar", "bar", 0, 350, "in turn at each position"},
          self.pressure_differences_bar);
    visit(Parameter{"hold_s", "s", 0.01, 600, "at each level"}, self.hold_s);
  }
};
[[nodiscard]] BenchRun plan(const PressureStepsProtocol& protocol);

}  // namespace spoolflow::rig
