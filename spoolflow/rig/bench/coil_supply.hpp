#pragma once
/// What feeds the coils during a run: the bench's amplifier or the valve's own electronics.
#include <cstdint>

#include "spoolflow/rig/bench/bench_run.hpp"
#include "spoolflow/rig/bench/valve_under_test.hpp"
#include "spoolflow/rig/electronics/electronics.hpp"
#include "spoolflow/rig/instruments/lvdt.hpp"
#include "spoolflow/rig/plant/solenoid.hpp"

namespace spoolflow::rig {

class CoilSupply {
 public:
  /// Both must outlive it.
  CoilSupply(const ValveUnderTest& valve, const BenchRun& run, std::uint64_t seed)
      : valve_(valve),
        run_(run),
        settings_(valve.electronics),
        voltage_held_(run.voltage_held),
        noise_(seed, "current sensing of the electronics") {}

  /// Of the valve's electronics, from now on.
  void set_dither(const Dither& dither) { settings_.dither = dither; }

  /// Mean voltages over the period that begins at `time_s`.
  SolenoidVoltages next(double time_s, LvdtReading& lvdt, const PlantState& state) {
    if (run_.coil_feed == CoilFeed::none) {
      return {};
    }
    const double current_b_A = winding_current_A(valve_.plant.solenoid_b, state.solenoid_b);
    if (run_.coil_feed == CoilFeed::bench_amplifier) {
      return {.a_V = 0, .b_V = amplifier_V(time_s, current_b_A)};
    }
    const ElectronicsInput input{.position_set_m = run_.position_set.at(time_s) * valve_.plant.spool.stroke_m,
                                 .position_signal_m = lvdt.valve_signal_m(),
                                 .current_a_A = winding_current_A(valve_.plant.solenoid_a, state.solenoid_a),
                                 .current_b_A = current_b_A};
    return step(settings_, electronics_, input, noise_);
  }

 private:
  double amplifier_V(double time_s, double current_A) {
    if (voltage_held_.at(time_s, false)) {
      amplifier_ = {};
      return run_.voltage_V.at(time_s);
    }
    const double set_A = run_.current_A.at(time_s) + dither_A(run_.dither, time_s);
    return step(valve_.bench_amplifier, amplifier_, set_A, current_A, electronics_period_s);
  }

  const ValveUnderTest& valve_;
  const BenchRun& run_;
  Electronics settings_;
  SpanReader<bool> voltage_held_;
  Noise noise_;
  ElectronicsState electronics_;
  CurrentControlState amplifier_;
};

}  // namespace spoolflow::rig
