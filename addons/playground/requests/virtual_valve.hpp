#pragma once
/// A valve of the virtual rig at work, with the sensor beside it, whose settings may change at any time.
#include <memory>
#include <vector>

#include "spoolflow/estimation/running_sensor.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/rig/bench/running_bench.hpp"

namespace spoolflow::playground {

/// What the user sets.
struct ValveSettings {
  double command = 0;                    ///< share of the stroke, 0 to 1
  double pressure_difference_Pa = 60e5;  ///< held over the valve
  double oil_temperature_C = 50;         ///< reached at 10 K/s
  double edge_rounding_m = 0;            ///< worn off every metering edge
  double friction_factor = 1;            ///< of the friction when new
  double dither_amplitude_A = 0;         ///< of a sine on the current
  double dither_frequency_Hz = 140;
};

/// One sample: what the sensor says, and what is true.
struct PlayedSample {
  double time_s;
  double flow_m3_per_s, flow_lower_m3_per_s, flow_upper_m3_per_s;
  double true_flow_m3_per_s;
  double position_m;  ///< as measured
  double current_A;   ///< likewise
  sensor::Status status;
};

class VirtualValve {
 public:
  /// The preset size_6 and a model of it, which is kept. Throws SettingsError, ModelError.
  explicit VirtualValve(model::Model model, std::uint64_t seed = 1);

  /// The samples of the next stretch of work at 1 kHz, with these settings from its beginning on; numbers outside a
  /// setting's range are taken at its end. Throws std::runtime_error as the rig does.
  [[nodiscard]] std::vector<PlayedSample> work(const ValveSettings& settings, double duration_s);

 private:
  void take(const ValveSettings& settings);

  model::Model model_;
  rig::ValveUnderTest valve_;
  rig::BenchRun run_;
  std::unique_ptr<rig::RunningBench> bench_;
  estimation::RunningSensor sensor_;
  rig::Dither dither_;
  rig::Wear wear_;
  recording::Recording recording_;
};

}  // namespace spoolflow::playground
