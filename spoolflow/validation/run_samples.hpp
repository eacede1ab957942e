#pragma once
/// A run's samples beside what the sensors answered, kept while the run is judged.
#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "spoolflow/estimation/estimator.hpp"
#include "spoolflow/numerics/meter_lag.hpp"
#include "spoolflow/plausibility/run_means.hpp"
#include "spoolflow/recording/reader.hpp"
#include "spoolflow/validation/known_meter.hpp"

namespace spoolflow::validation {

/// What one estimator answered; one entry a sample.
struct Answers {
  estimation::Estimator estimator;
  std::vector<float> flow_m3_per_s, lower_m3_per_s, upper_m3_per_s;
  std::vector<float> pressure_difference_Pa;
  std::vector<float> magnetic_force_N, spring_force_N, flow_force_N, friction_force_N;
  std::vector<sensor::Status> status;
};

/// Columns are equally long, or empty where a channel was not recorded. NaN: a missing sample.
struct RunSamples {
  std::vector<double> time_s;
  std::vector<double> position_m, position_set;  ///< position_set as a share of the stroke
  std::vector<float> current_A, voltage_V, oil_temperature_K;
  std::vector<float> reference_m3_per_s, pressure_difference_Pa;  ///< instruments; no sensor reads them
  std::vector<Answers> answers;                                   ///< in the order of the estimators
  recording::ReadNotes notes;
  plausibility::RunMeans means;             ///< of all channels that were read
  std::vector<std::string> contradictions;  ///< of the observer's forces to the model, at most one
};

/// Runs the estimators over a recording. The reference is the channel flow_reference, else flow; the pressure
/// difference is its own channel, else upstream less downstream. `progress` receives the share read.
[[nodiscard]] RunSamples estimate_run(const model::Model& model, const std::filesystem::path& recording,
                                      const recording::ChannelMap& channels,
                                      const std::vector<estimation::Estimator>& estimators,
                                      const std::function<void(double)>& progress);

/// The reference meter, as the run shows it beside the leading estimator, else beside what the model's edges pass at
/// the measured pressure difference; of source `none` where neither shows it.
[[nodiscard]] KnownMeter meter_of(const model::Model& model, const RunSamples& run);

/// Shows flow and band as the reference meter would.
void apply_lag(std::span<const double> time_s, Answers& answers, const numerics::MeterLag& meter);

}  // namespace spoolflow::validation
