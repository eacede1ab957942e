#pragma once
/// What an analysis is asked: a TOML file whose every key has a default. The keys, their units, ranges and reasons are
/// described here once; the template that `--print-scenario` prints visits the same description.
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "spoolflow/analysis/monte_carlo.hpp"
#include "spoolflow/rig/numerics/parameter.hpp"
#include "spoolflow/uncertainty/input_uncertainties.hpp"

namespace spoolflow::analysis {

using rig::Parameter;

/// Where the budget is made up.
struct PointSettings {
  std::vector<double> positions_percent{25, 50, 75, 95};
  std::vector<double> pressure_differences_bar{};  ///< empty: three levels of the calibrated range
  double oil_temperature_C = NAN;                  ///< NaN: that of the flow-force map
  bool pairs = false;
  bool closing = false;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"positions_percent", "%", 1, 100, "of the stroke"}, self.positions_percent);
    visit(Parameter{"pressure_differences_bar", "bar", 0.1, 350,
                    "each with each position; absent: three levels of the calibrated range"},
          self.pressure_differences_bar);
    visit(Parameter{"oil_temperature_C", "degC", -20, 120, "absent: that of the flow-force map"},
          self.oil_temperature_C);
  }
};

/// Half widths of rectangular distributions; noises are standard deviations.
struct InstrumentSettings {
  double position_zero_um = NAN;
  double position_gain_percent = 0.1;
  double position_noise_um = NAN;
  double current_gain_percent = 0.02;
  double current_offset_mA = 1;
  double current_noise_mA = 0.5;
  double voltage_offset_mV = 5;
  double thermometer_K = 0.3;
  double oil_temperature_away_K = NAN;
  double load_cell_percent = 0.1;
  double flow_meter_percent = 0.5;
  double oil_density_percent = 1;
  double oil_viscosity_percent = 10;
  bool one_load_cell = false;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"position_zero_um", "um", 0, 1000, "absent: the model's drift or backlash"}, self.position_zero_um);
    visit(Parameter{"position_gain_percent", "%", 0, 10, "linearity of the position sensor, of the reading"},
          self.position_gain_percent);
    visit(Parameter{"position_noise_um", "um", 0, 100, "standard deviation; absent: the model's"},
          self.position_noise_um);
    visit(Parameter{"current_gain_percent", "%", 0, 10, "shunt"}, self.current_gain_percent);
    visit(Parameter{"current_offset_mA", "mA", 0, 100, "amplifier behind the shunt"}, self.current_offset_mA);
    visit(Parameter{"current_noise_mA", "mA", 0, 100, "standard deviation of one sample"}, self.current_noise_mA);
    visit(Parameter{"voltage_offset_mV", "mV", 0, 10000, "divider and converter"}, self.voltage_offset_mV);
    visit(Parameter{"thermometer_K", "K", 0, 50, "of the sensor that reads the oil temperature"}, self.thermometer_K);
    visit(Parameter{"oil_temperature_away_K", "K", 0, 100,
                    "of the oil about its map's, for the sensor that reads none; absent: the model's range"},
          self.oil_temperature_away_K);
    visit(Parameter{"load_cell_percent", "%", 0, 10, "of the benches, of the reading"}, self.load_cell_percent);
    visit(Parameter{"flow_meter_percent", "%", 0, 10, "of the bench, of the reading"}, self.flow_meter_percent);
    visit(Parameter{"oil_density_percent", "%", 0, 20, "of the oil in use about the calibrated one"},
          self.oil_density_percent);
    visit(Parameter{"oil_viscosity_percent", "%", 0, 80, "of the oil in use about the calibrated one"},
          self.oil_viscosity_percent);
  }
};

struct TrialSettings {
  double trials = 10000;
  double most_trials = 1e6;
  double digits = 1;
  double trials_along_run = 400;
  bool adaptive = false;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"trials", "1", 100, 1e7, "at each point; of one block where adaptive"}, self.trials);
    visit(Parameter{"most_trials", "1", 100, 1e8, "of an adaptive run"}, self.most_trials);
    visit(Parameter{"digits", "1", 1, 2, "of the standard uncertainty that are to be right (JCGM 101, 7.9.2)"},
          self.digits);
    visit(Parameter{"trials_along_run", "1", 20, 1e5, "whole replays of the recording"}, self.trials_along_run);
  }
};

/// The grid of the local map.
struct MapSettings {
  double positions = 20;
  double pressure_differences = 12;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"positions", "1", 2, 200, "columns of the map"}, self.positions);
    visit(Parameter{"pressure_differences", "1", 2, 200, "rows of the map"}, self.pressure_differences);
  }
};

/// Comparison with the reference meter of a recording.
struct RunSettings {
  double reference_meter_percent = 0.5;
  double reference_lag_ms = 30;
  bool other_bench = false;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"reference_meter_percent", "%", 0, 20, "half width, of the reading; counts with other_bench"},
          self.reference_meter_percent);
    visit(Parameter{"reference_lag_ms", "ms", 0, 10000, "first order; the estimate is lagged likewise"},
          self.reference_lag_ms);
  }
};

/// The spread of valves, oils and instruments on the virtual rig: standard deviations cut off at 2.5 of them, unless
/// the reason says otherwise.
struct SpreadSettings {
  double spring_rate_percent = 2;
  double spring_preload_percent = 6;
  double friction_percent = 20;
  double notch_width_percent = 2;
  double overlap_um = 8;
  double discharge_percent = 1;
  double clearance_percent = 10;
  double radial_gap_percent = 6;
  double saturation_percent = 1;
  double coil_resistance_percent = 2;
  double coercive_field_percent = 15;
  double oil_coldest_C = 30;
  double oil_warmest_C = 70;
  double oil_density_percent = 0.5;
  double oil_viscosity_percent = 5;
  double position_gain_percent = 0.2;
  double position_zero_um = 5;
  double position_drift_percent = 15;
  double current_gain_percent = 0.1;
  double current_offset_mA = 1;
  double voltage_gain_percent = 0.2;
  double voltage_offset_mV = 5;
  double thermometer_K = 0.3;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"spring_rate_percent", "%", 0, 10, "wire diameter to the fourth power"}, self.spring_rate_percent);
    visit(Parameter{"spring_preload_percent", "%", 0, 30, "lengths of spring and housing"},
          self.spring_preload_percent);
    visit(Parameter{"friction_percent", "%", 0, 40, "fit and surface of spool and armature"}, self.friction_percent);
    visit(Parameter{"notch_width_percent", "%", 0, 10, "milled notches"}, self.notch_width_percent);
    visit(Parameter{"overlap_um", "um", 0, 30, "edge positions of spool and body"}, self.overlap_um);
    visit(Parameter{"discharge_percent", "%", 0, 5, "sharpness of the edges"}, self.discharge_percent);
    visit(Parameter{"clearance_percent", "%", 0, 30, "of the spool in its bore"}, self.clearance_percent);
    visit(Parameter{"radial_gap_percent", "%", 0, 20, "between armature and tube"}, self.radial_gap_percent);
    visit(Parameter{"saturation_percent", "%", 0, 4, "melt and annealing of the iron"}, self.saturation_percent);
    visit(Parameter{"coil_resistance_percent", "%", 0, 10, "of the winding"}, self.coil_resistance_percent);
    visit(Parameter{"coercive_field_percent", "%", 0, 35, "annealing of the iron"}, self.coercive_field_percent);
    visit(Parameter{"oil_coldest_C", "degC", -10, 90, "of the oil, uniform from here"}, self.oil_coldest_C);
    visit(Parameter{"oil_warmest_C", "degC", -10, 90, "to here"}, self.oil_warmest_C);
    visit(Parameter{"oil_density_percent", "%", 0, 5, "batches of one grade"}, self.oil_density_percent);
    visit(Parameter{"oil_viscosity_percent", "%", 0, 20, "batches of one grade"}, self.oil_viscosity_percent);
    visit(Parameter{"position_gain_percent", "%", 0, 2, "of the position sensor after setting"},
          self.position_gain_percent);
    visit(Parameter{"position_zero_um", "um", 0, 30, "after setting"}, self.position_zero_um);
    visit(Parameter{"position_drift_percent", "%", 0, 100, "of the zero's drift with temperature"},
          self.position_drift_percent);
    visit(Parameter{"current_gain_percent", "%", 0, 2, "shunt of valve electronics"}, self.current_gain_percent);
    visit(Parameter{"current_offset_mA", "mA", 0, 20, "amplifier behind the shunt"}, self.current_offset_mA);
    visit(Parameter{"voltage_gain_percent", "%", 0, 2, "divider"}, self.voltage_gain_percent);
    visit(Parameter{"voltage_offset_mV", "mV", 0, 100, "divider"}, self.voltage_offset_mV);
    visit(Parameter{"thermometer_K", "K", 0, 3, "in the oil"}, self.thermometer_K);
  }
};

/// The global study on the virtual rig.
struct StudySettings {
  double base_samples = 32;
  double run_s = 8;
  std::string valve = "auto";  ///< preset, valve file, or "auto": the preset whose rated flow is nearest
  bool skip = false;
  bool given_model = false;
  SpreadSettings spread;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(
        Parameter{"base_samples", "1", 2, 65536, "rows of the design, best a power of two; runs = rows (factors + 2)"},
        self.base_samples);
    visit(Parameter{"run_s", "s", 1, 600, "length of each simulated duty cycle"}, self.run_s);
    visit("spread", self.spread);
  }
};

struct Scenario {
  std::uint64_t seed = 1;
  PointSettings points;
  InstrumentSettings instruments;
  TrialSettings monte_carlo;
  MapSettings map;
  RunSettings run;
  StudySettings study;
};

/// Throws rig::SettingsError with file, line, value, range and the nearest key.
[[nodiscard]] Scenario read_scenario(const std::filesystem::path& file);

/// A scenario file with every key at its default, its unit, range and reason beside it.
[[nodiscard]] std::string scenario_template();

/// As the budget takes them, each with its source.
[[nodiscard]] uncertainty::InstrumentFigures instrument_figures(const InstrumentSettings& settings);

}  // namespace spoolflow::analysis
