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
  double gain_error = 1.0e-4;
  double offset_A = 0.0;
  double noise_A = 1.6e-3;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"gain_error", "1", -0.05, 0.05, "shunt of 0.02 % (paper, section 3)"}, self.gain_error);
    visit(Parameter{"offset_A", "A", -0.1, 0.1, "input offset over the shunt: below 1 mA"}, self.offset_A);
    visit(Parameter{"noise_A", "A", 0, 0.1, "one conversion at 10 kHz; 0.5 mA in a mean over 1 ms"}, self.noise_A);
  }
};

struct VoltageDivider {
  double gain_error = -2.0e-4;
  double offset_V = 0.0;
  double noise_V = 0.09;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"gain_error", "1", -0.05, 0.05, "resistors of 0.05 %"}, self.gain_error);
    visit(Parameter{"offset_V", "V", -1, 1, "below 5 mV"}, self.offset_V);
    visit(Parameter{"noise_V", "V", 0, 2, "one conversion at 10 kHz; 30 mV in a mean over 1 ms"}, self.noise_V);
  }
};

inline TransducerErrors errors(const CurrentShunt& shunt) {
  return {.gain_error = shunt.gain_error, .offset = shunt.offset_A, .noise = shunt.noise_A};
}
inline TransducerErrors errors(const VoltageDivider& divider) {
  return {.gain_error = divider.gain_error, .offset = divider.offset_V, .noise = divider.noise_V};
}

/// The bench's load cell between drive and spool or carriage and armature.
struct LoadCell {
  double gain_error = 5.0e-4;
  double offset_N = 0.02;
  double time_constant_s = 1.0e-4;
  double noise_N = 0.04;
  double resolution_N = 0.002;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"gain_error", "1", -0.05, 0.05, "class 0.1 cells: within 0.1 %"}, self.gain_error);
    visit(Parameter{"offset_N", "N", -5, 5, "after taring: some hundredths of a newton"}, self.offset_N);
    visit(Parameter{"time_constant_s", "s", 0, 1, "bridge amplifier of 1 to 2 kHz"}, self.time_constant_s);
    visit(Parameter{"noise_N", "N", 0, 5, "standard deviation; 0.02 % of a 200 N cell"}, self.noise_N);
    visit(Parameter{"resolution_N", "N", 0, 1, "16 bit over 130 N; 0: none"}, self.resolution_N);
  }
};

inline TransducerErrors errors(const LoadCell& cell) {
  return {.gain_error = cell.gain_error,
          .offset = cell.offset_N,
          .time_constant_s = cell.time_constant_s,
          .noise = cell.noise_N,
          .resolution = cell.resolution_N};
}

/// Before and behind the metering edge.
struct PressureSensor {
  double gain_error = 0.0;
  double offset_Pa = 0.0;
  double time_constant_s = 1.0e-3;
  double noise_Pa = 0.055e5;
  double resolution_Pa = 100.0;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"gain_error", "1", -0.05, 0.05, "calibrated pairs: within 0.1 %"}, self.gain_error);
    visit(Parameter{"offset_Pa", "Pa", -5e5, 5e5, "0.1 % of a 100 bar range is 0.1 bar"}, self.offset_Pa);
    visit(Parameter{"time_constant_s", "s", 0, 1, "data sheets: 10 to 90 % in 1 to 2 ms"}, self.time_constant_s);
    visit(Parameter{"noise_Pa", "Pa", 0, 5e5, "standard deviation; 0.05 % of a 100 bar range"}, self.noise_Pa);
    visit(Parameter{"resolution_Pa", "Pa", 0, 1e5, "16 bit over 100 bar is 150 Pa; 0: none"}, self.resolution_Pa);
  }
};

inline TransducerErrors errors(const PressureSensor& sensor) {
  return {.gain_error = sensor.gain_error,
          .offset = sensor.offset_Pa,
          .time_constant_s = sensor.time_constant_s,
          .noise = sensor.noise_Pa,
          .resolution = sensor.resolution_Pa};
}

/// Resistance thermometer in the oil before the valve.
struct Thermometer {
  double offset_K = 0.0;
  double time_constant_s = 2.0;
  double noise_K = 0.05;
  double resolution_K = 0.01;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"offset_K", "K", -10, 10, "Pt100 class A: within 0.3 K"}, self.offset_K);
    visit(Parameter{"time_constant_s", "s", 0, 60, "3 mm probe in flowing oil: 1 to 5 s"}, self.time_constant_s);
    visit(Parameter{"noise_K", "K", 0, 2, "standard deviation"}, self.noise_K);
    visit(Parameter{"resolution_K", "K", 0, 1, "of the transmitter; 0: none"}, self.resolution_K);
  }
};

inline TransducerErrors errors(const Thermometer& thermometer) {
  return {.offset = thermometer.offset_K,
          .time_constant_s = thermometer.time_constant_s,
          .noise = thermometer.noise_K,
          .resolution = thermometer.resolution_K};
}

}  // namespace spoolflow::rig
