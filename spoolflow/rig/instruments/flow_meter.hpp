#pragma once
/// Gear flow meter behind the valve: its gears pulse with every tooth, its display lags.
///
///     passing = Q (1 + pulsation sin(2 pi V/V_tooth)),   dV/dt = Q
///     reading = (1 + gain) lag(passing) + noise
#include <cmath>

#include "spoolflow/rig/numerics/acquisition.hpp"
#include "spoolflow/rig/numerics/elementary_functions.hpp"
#include "spoolflow/rig/numerics/noise.hpp"
#include "spoolflow/rig/numerics/parameter.hpp"

namespace spoolflow::rig {

struct FlowMeter {
  double gain_error = 1.0e-3;
  double offset_m3_per_s = 0.0;
  double time_constant_s = 0.030;
  double pulsation = 0.01;
  double tooth_volume_m3 = 1.0e-6;
  double noise_m3_per_s = 8.0e-7;
  double resolution_m3_per_s = 1.6e-8;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"gain_error", "1", -0.05, 0.05, "calibrated gear meters: 0.1 to 0.5 % of reading"},
          self.gain_error);
    visit(Parameter{"offset_m3_per_s", "m3/s", -1e-5, 1e-5, "slip at low flow"}, self.offset_m3_per_s);
    visit(Parameter{"time_constant_s", "s", 0, 1, "3 to 50 ms by data sheets; frequency to voltage about 30 ms"},
          self.time_constant_s);
    visit(Parameter{"pulsation", "1", 0, 0.2, "amplitude of the delivery of one tooth pair"}, self.pulsation);
    visit(Parameter{"tooth_volume_m3", "m3", 1e-8, 1e-4, "1 cm3 a tooth: size 4 to 5 for 80 L/min"},
          self.tooth_volume_m3);
    visit(Parameter{"noise_m3_per_s", "m3/s", 0, 1e-4, "standard deviation; 0.05 L/min"}, self.noise_m3_per_s);
    visit(Parameter{"resolution_m3_per_s", "m3/s", 0, 1e-5, "0.001 L/min; 0: none"}, self.resolution_m3_per_s);
  }
};

/// One gear meter at work.
class FlowMeterReading {
 public:
  FlowMeterReading(const FlowMeter& meter, std::uint64_t seed, double flow_m3_per_s)
      : meter_(meter), noise_(seed, "flow meter"), lagged_m3_per_s_(flow_m3_per_s) {}

  void follow(double flow_m3_per_s, double dt_s) {
    teeth_ += flow_m3_per_s * dt_s / meter_.tooth_volume_m3;
    teeth_ -= std::floor(teeth_);
    const double passing = flow_m3_per_s * (1 + meter_.pulsation * sine_of_turns(teeth_));
    lagged_m3_per_s_ = lagged(lagged_m3_per_s_, passing, dt_s, meter_.time_constant_s, lag_);
  }
  [[nodiscard]] double reading_m3_per_s() {
    const double signal = (1 + meter_.gain_error) * lagged_m3_per_s_ + meter_.offset_m3_per_s;
    return quantised(signal + meter_.noise_m3_per_s * noise_.normal(), meter_.resolution_m3_per_s);
  }

 private:
  FlowMeter meter_;
  Noise noise_;
  LagMemory lag_;
  double lagged_m3_per_s_;
  double teeth_ = 0;  ///< share of the tooth passing now
};

}  // namespace spoolflow::rig
