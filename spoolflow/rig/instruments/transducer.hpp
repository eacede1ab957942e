#pragma once
/// Load cells, pressure sensors, thermometers and the coil's shunt and voltage divider: instruments whose errors are of
/// one kind.
///
///     reading = quantised(lag((1 + gain) true + offset) + noise)
#include "spoolflow/rig/numerics/acquisition.hpp"
#include "spoolflow/rig/numerics/noise.hpp"
#include "spoolflow/rig/numerics/parameter.hpp"

namespace spoolflow::rig {

/// Error figures of one instrument in the unit of its quantity.
struct TransducerErrors {
  double gain_error = 0.0;
  double offset = 0.0;
  double time_constant_s = 0.0;
  double noise = 0.0;  ///< standard deviation of one reading
  double resolution = 0.0;
};

/// One instrument at work.
class Transducer {
 public:
  Transducer(const TransducerErrors& errors, std::uint64_t seed, std::string_view name, double value)
      : errors_(errors), noise_(seed, name), lagged_(value) {}

  /// The signal follows the true value for `dt_s`.
  void follow(double value, double dt_s) { lagged_ = lagged(lagged_, value, dt_s, errors_.time_constant_s, lag_); }
  /// One reading; `noise_share` below 1 for a mean over several conversions.
  [[nodiscard]] double reading(double noise_share = 1.0) {
    const double signal = (1 + errors_.gain_error) * lagged_ + errors_.offset;
    return quantised(signal + noise_share * errors_.noise * noise_.normal(), errors_.resolution);
  }

 private:
  TransducerErrors errors_;
  Noise noise_;
  LagMemory lag_;
  double lagged_;
};

/// Shunt and voltage divider at the coil. Both channels are means over one sample period, so their noise falls with the
/// number of conversions averaged.
struct CurrentShunt {
  TransducerErrors errors{.gain_error = 1.0e-4, .noise = 1.6e-3};  ///< [A]

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"gain_error", "1", -0.05, 0.05, "shunt of 0.02 % (paper, section 3)"}, self.errors.gain_error);
    visit(Parameter{"offset_A", "A", -0.1, 0.1, "input offset over the shunt: below 1 mA"}, self.errors.offset);
    visit(Parameter{"noise_A", "A", 0, 0.1, "one conversion at 10 kHz; 0.5 mA in a mean over 1 ms"}, self.errors.noise);
  }
};

struct VoltageDivider {
  TransducerErrors errors{.gain_error = -2.0e-4, .noise = 0.09};  ///< [V]

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"gain_error", "1", -0.05, 0.05, "resistors of 0.05 %"}, self.errors.gain_error);
    visit(Parameter{"offset_V", "V", -1, 1, "below 5 mV"}, self.errors.offset);
    visit(Parameter{"noise_V", "V", 0, 2, "one conversion at 10 kHz; 30 mV in a mean over 1 ms"}, self.errors.noise);
  }
};

/// The bench's load cell between drive and spool or carriage and armature.
struct LoadCell {
  TransducerErrors errors{
      .gain_error = 5.0e-4, .offset = 0.02, .time_constant_s = 1.0e-4, .noise = 0.04, .resolution = 0.002};  ///< [N]

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"gain_error", "1", -0.05, 0.05, "class 0.1 cells: within 0.1 %"}, self.errors.gain_error);
    visit(Parameter{"offset_N", "N", -5, 5, "after taring: some hundredths of a newton"}, self.errors.offset);
    visit(Parameter{"time_constant_s", "s", 0, 1, "bridge amplifier of 1 to 2 kHz"}, self.errors.time_constant_s);
    visit(Parameter{"noise_N", "N", 0, 5, "standard deviation; 0.02 % of a 200 N cell"}, self.errors.noise);
    visit(Parameter{"resolution_N", "N", 0, 1, "16 bit over 130 N; 0: none"}, self.errors.resolution);
  }
};

/// Before and behind the metering edge.
struct PressureSensor {
  TransducerErrors errors{.time_constant_s = 1.0e-3, .noise = 0.055e5, .resolution = 100.0};  ///< [Pa]

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"gain_error", "1", -0.05, 0.05, "calibrated pairs: within 0.1 %"}, self.errors.gain_error);
    visit(Parameter{"offset_Pa", "Pa", -5e5, 5e5, "0.1 % of a 100 bar range is 0.1 bar"}, self.errors.offset);
    visit(Parameter{"time_constant_s", "s", 0, 1, "data sheets: 10 to 90 % in 1 to 2 ms"}, self.errors.time_constant_s);
    visit(Parameter{"noise_Pa", "Pa", 0, 5e5, "standard deviation; 0.05 % of a 100 bar range"}, self.errors.noise);
    visit(Parameter{"resolution_Pa", "Pa", 0, 1e5, "16 bit over 100 bar is 150 Pa; 0: none"}, self.errors.resolution);
  }
};

/// Resistance thermometer in the oil before the valve.
struct Thermometer {
  TransducerErrors errors{.time_constant_s = 2.0, .noise = 0.05, .resolution = 0.01};  ///< [K]

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"offset_K", "K", -10, 10, "Pt100 class A: within 0.3 K"}, self.errors.offset);
    visit(Parameter{"time_constant_s", "s", 0, 60, "3 mm probe in flowing oil: 1 to 5 s"}, self.errors.time_constant_s);
    visit(Parameter{"noise_K", "K", 0, 2, "standard deviation"}, self.errors.noise);
    visit(Parameter{"resolution_K", "K", 0, 1, "of the transmitter; 0: none"}, self.errors.resolution);
  }
};

}  // namespace spoolflow::rig
