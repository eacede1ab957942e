#pragma once
/// Runs one planned recording: plant, instruments and electronics together, at the electronics' period.
#include <functional>

#include "spoolflow/recording/recording.hpp"
#include "spoolflow/rig/bench/bench_run.hpp"
#include "spoolflow/rig/bench/ground_truth.hpp"
#include "spoolflow/rig/bench/valve_under_test.hpp"

namespace spoolflow::rig {

struct Simulation {
  recording::Recording recording;  ///< what the instruments show; the run's channels only
  GroundTruth truth;               ///< empty unless asked for
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

/// `valve` as it is (spread and wear go in by as_built); all noise and faults follow from `seed`. Current and voltage
/// are means over the sample period that ends at the time stamp, everything else is read at the time stamp.
/// Throws std::runtime_error, naming time and quantity, should the plant leave the finite numbers.
[[nodiscard]] Simulation simulate(const ValveUnderTest& valve, const BenchRun& run, std::uint64_t seed,
                                  const SimulationOptions& options = {});

}  // namespace spoolflow::rig
