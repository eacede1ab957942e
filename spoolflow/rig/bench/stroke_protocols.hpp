#pragma once
/// Benches that stroke the spool to and fro at held pressure differences: the axial-force bench, and the flow bench.
#include <optional>
#include <vector>

#include "spoolflow/rig/bench/bench_run.hpp"
#include "spoolflow/rig/numerics/parameter.hpp"

namespace spoolflow::rig {

/// The axial-force bench (paper section 3, Fig 5): solenoids removed, an external drive opens and closes the spool at
/// each held pressure difference. At zero pressure it is the spring test.
struct AxialForceProtocol {
  std::vector<double> pressure_differences_bar{5, 10, 20, 30, 40, 50, 60, 70};
  double oil_temperature_C = 50.0;
  double temperature_rise_K = 0.3;
  double rate_percent_per_s = 5.0;
  double hold_s = 1.0;
  double sample_rate_Hz = 100.0;
  /// Which edges the bench feeds: held_difference, held_path or held_return; absent: of a whole valve its path, else as
  /// the valve's load has it.
  std::optional<LoadKind> load{};

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(
        Parameter{"pressure_differences_bar", "bar", 0, 350, "each level is opened and closed once; 0: springs alone"},
        self.pressure_differences_bar);
    visit(Parameter{"oil_temperature_C", "degC", -20, 100, "at the start"}, self.oil_temperature_C);
    visit(Parameter{"temperature_rise_K", "K", -20, 20, "over the whole run; throttling warms the oil"},
          self.temperature_rise_K);
    visit(Parameter{"rate_percent_per_s", "%/s", 0.5, 100, "quasi-static at 5 %/s (paper)"}, self.rate_percent_per_s);
    visit(Parameter{"hold_s", "s", 0, 60, "fully open and closed"}, self.hold_s);
    visit(Parameter{"sample_rate_Hz", "Hz", 10, 10000, "of the recorder; a divisor of 10 kHz"}, self.sample_rate_Hz);
  }
};

/// The settings of the spring test: no pressure, 25 C.
[[nodiscard]] AxialForceProtocol spring_protocol();

[[nodiscard]] BenchRun plan(const AxialForceProtocol& protocol, double stroke_m);

/// The flow bench: the valve strokes both ways by its own electronics at each held pressure difference, beside a flow
/// meter, its dither switched off. With the pump off it is the test of springs and friction.
struct FlowBenchProtocol {
  std::vector<double> pressure_differences_bar{5, 10, 20, 30, 40, 50, 60, 70};
  double oil_temperature_C = 50.0;
  double temperature_rise_K = 0.3;
  double rate_percent_per_s = 8.0;
  double fast_rate_percent_per_s = 0.0;
  double hold_s = 1.0;
  double sample_rate_Hz = 500.0;
  /// Which edges the bench feeds: held_difference, held_path or held_return; absent: of a whole valve its path, else as
  /// the valve's load has it.
  std::optional<LoadKind> load{};

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"pressure_differences_bar", "bar", 0, 350, "one stroke up and down at each; 0: the pump is off"},
          self.pressure_differences_bar);
    visit(Parameter{"oil_temperature_C", "degC", -20, 100, "at the start"}, self.oil_temperature_C);
    visit(Parameter{"temperature_rise_K", "K", -20, 20, "over the whole run; throttling warms the oil"},
          self.temperature_rise_K);
    visit(Parameter{"rate_percent_per_s", "%/s", 0.5, 100, "slow enough for the flow meter, fast enough to slide"},
          self.rate_percent_per_s);
    visit(Parameter{"fast_rate_percent_per_s", "%/s", 0, 10000, "of one more stroke at the last level; 0: none"},
          self.fast_rate_percent_per_s);
    visit(Parameter{"hold_s", "s", 0, 60, "fully open, and closed before and after each stroke"}, self.hold_s);
    visit(Parameter{"sample_rate_Hz", "Hz", 10, 10000, "of the recorder; a divisor of 10 kHz"}, self.sample_rate_Hz);
  }
};

/// Two slow strokes and a fast one with the pump off.
[[nodiscard]] FlowBenchProtocol unpressurised_protocol();

[[nodiscard]] BenchRun plan(const FlowBenchProtocol& protocol);

}  // namespace spoolflow::rig
