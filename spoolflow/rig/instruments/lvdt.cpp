#include "spoolflow/rig/instruments/lvdt.hpp"

#include <algorithm>

#include "spoolflow/rig/numerics/acquisition.hpp"
#include "spoolflow/rig/numerics/elementary_functions.hpp"

namespace spoolflow::rig {

LvdtReading::LvdtReading(const Lvdt& lvdt, std::uint64_t seed, double position_m, double temperature_C)
    : lvdt_(lvdt),
      valve_noise_(seed, "lvdt at the valve"),
      recorder_noise_(seed, "lvdt at the recorder"),
      faults_(seed, "lvdt faults"),
      core_m_(position_m),
      signal_m_(undelayed_m(temperature_C)),
      fault_begin_s_(faults_.waiting_time_s(lvdt.fault_rate_per_s)),
      fault_end_s_(fault_begin_s_) {}

double LvdtReading::undelayed_m(double temperature_C) const {
  const double bow = lvdt_.linearity * lvdt_.range_m * sine_of_turns(core_m_ / lvdt_.range_m);
  const double zero_m =
      lvdt_.zero_offset_m + lvdt_.zero_drift_per_K * lvdt_.range_m * (temperature_C - lvdt_.reference_temperature_C);
  return (1 + lvdt_.gain_error) * core_m_ + bow + zero_m;
}

void LvdtReading::follow(double position_m, double temperature_C, double dt_s) {
  core_m_ = std::clamp(core_m_, position_m - lvdt_.backlash_m, position_m + lvdt_.backlash_m);
  signal_m_ = lagged(signal_m_, undelayed_m(temperature_C), dt_s, lvdt_.time_constant_s, lag_);
}

double LvdtReading::valve_signal_m() {
  return quantised(signal_m_ + lvdt_.noise_m * valve_noise_.normal(), lvdt_.resolution_m);
}

double LvdtReading::acquired_m(double time_s) {
  return quantised(signal_m_ + lvdt_.noise_m * recorder_noise_.normal() + fault_m(time_s), lvdt_.resolution_m);
}

double LvdtReading::fault_m(double time_s) {
  while (time_s >= fault_end_s_) {
    if (time_s < fault_begin_s_) {
      return 0;
    }
    if (fault_end_s_ > fault_begin_s_) {  // this one is over, wait for the next
      fault_begin_s_ = fault_end_s_ + faults_.waiting_time_s(lvdt_.fault_rate_per_s);
      fault_end_s_ = fault_begin_s_;
      continue;
    }
    fault_end_s_ = fault_begin_s_ + lvdt_.fault_duration_s * faults_.uniform(0.2, 1.8);
    const double sign = faults_.uniform() < 0.5 ? -1 : 1;
    jump_m_ = sign * lvdt_.range_m * lvdt_.fault_jump * faults_.uniform(0.5, 1.0);
  }
  return time_s >= fault_begin_s_ ? jump_m_ : 0;
}

}  // namespace spoolflow::rig
