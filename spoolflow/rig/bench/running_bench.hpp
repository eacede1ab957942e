#pragma once
/// A bench at work, one period of the electronics after the other: plant, instruments and electronics together.
#include <cstdint>
#include <functional>

#include "spoolflow/recording/recording.hpp"
#include "spoolflow/rig/bench/bench_run.hpp"
#include "spoolflow/rig/bench/instrument_panel.hpp"
#include "spoolflow/rig/bench/valve_under_test.hpp"
#include "spoolflow/rig/electronics/electronics.hpp"
#include "spoolflow/rig/instruments/lvdt.hpp"
#include "spoolflow/rig/plant/solenoid.hpp"

namespace spoolflow::rig {

/// What feeds the coils during a run: the bench's amplifier or the valve's own electronics.
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

/// What the electronics have of one recorded sample, as the instruments show it; NaN where the run does not record it.
struct MeasuredSample {
  double time_s;
  double current_A;                 ///< mean over the sample period that ends at `time_s`
  double voltage_V;                 ///< likewise
  double current_a_A, current_b_A;  ///< likewise, of a whole valve
  double voltage_a_V, voltage_b_V;
  double position_m;
  double oil_temperature_K;
};

struct SimulationOptions {
  bool with_truth = false;
  /// Called at each recorded sample: the dither that the valve's electronics lay on the set current until the next one.
  /// Without it the electronics keep their own.
  std::function<Dither(const MeasuredSample&)> dither{};
  /// Called at each recorded sample, after `dither`.
  std::function<void(const MeasuredSample&)> each_sample{};
  /// Called at each recorded sample: the plant as it has become until then, by wear. Spread and the run's own
  /// arrangement are in it.
  std::function<void(double time_s, PlantParameters& plant)> age{};
  bool keeps_recording = true;                   ///< false: the recording that comes back holds nothing
  std::function<void(double share)> progress{};  ///< called some hundred times, 0 to 1
};

class RunningBench {
 public:
  /// As simulate(). The run must outlive it, and its courses may be drawn on while it works.
  RunningBench(const ValveUnderTest& valve, const BenchRun& run, std::uint64_t seed);
  RunningBench(const RunningBench&) = delete;
  RunningBench& operator=(const RunningBench&) = delete;

  /// The next period; returns whether a sample was recorded at its beginning, in `recording`. Calls of the options
  /// dither, age and each_sample, and keeps_recording. Throws as simulate().
  bool tick(recording::Recording& recording, const SimulationOptions& options);

  /// The same in parts, for plants that are stepped together: `begin` with the truth of the period's first instant
  /// where `wants_truth`, then the plant's step with `input`, then `end` with what it made of the state. Not with
  /// options.age.
  [[nodiscard]] bool wants_truth() const { return samples() || tick_ % ticks_per_slow_update == 0; }
  bool begin(const PlantOutput* truth, recording::Recording& recording, const SimulationOptions& options);
  void end(const PlantState& state);
  [[nodiscard]] const PlantParameters& plant() const { return tested_.plant; }
  [[nodiscard]] const PlantState& state() const { return state_; }
  [[nodiscard]] const PlantInput& input() const { return input_; }

  /// Of the period that comes next.
  [[nodiscard]] double time_s() const;
  /// What really was at the last sample.
  [[nodiscard]] const PlantOutput& truth() const { return truth_; }

 private:
  /// How often the slow instruments follow and the oil's temperature is set, between samples.
  static constexpr std::int64_t ticks_per_slow_update = 10;

  [[nodiscard]] bool samples() const { return tick_ == next_sample_; }
  void follow();
  void store_sample(recording::Recording& recording, const SimulationOptions& options, double time_s);

  const BenchRun& run_;
  ValveUnderTest tested_;
  Instruments instruments_;
  PlantInput input_;
  PlantState state_;
  PlantOutput truth_;
  InstrumentPanel panel_;
  CoilSupply coil_supply_;
  ActuatorAtEnd actuator_;
  SpanReader<double> sample_rate_;
  SpanReader<double> test_;
  SolenoidVoltages voltages_;
  std::int64_t tick_ = 0, next_sample_ = 0, observed_ = 0;
};

}  // namespace spoolflow::rig
