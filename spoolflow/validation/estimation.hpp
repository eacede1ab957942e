#pragma once
/// Runs a model's sensor over a recording, block by block, as the valve would: one sample after the other.
#include <string>
#include <string_view>
#include <vector>

#include "spoolflow/model/model.hpp"
#include "spoolflow/model/running_sensor.hpp"
#include "spoolflow/recording/reader.hpp"
#include "spoolflow/validation/estimator.hpp"

namespace spoolflow::validation {

/// The observer where the model has one.
[[nodiscard]] Estimator best_estimator(const model::Model& model);

/// What the sensor reads of a recording, and nothing else: time, current, position; voltage and oil temperature where
/// they are.
[[nodiscard]] recording::ReadOptions sensor_channels(const model::Model& model, recording::ChannelMap channels);

/// One sensor in operation; see RunningSensor for time and for what comes before the first complete sample.
class Estimation {
 public:
  /// Keeps a reference to the model. Throws ModelError where the model is not calibrated for the estimator.
  Estimation(const model::Model& model, Estimator estimator);
  /// One estimate a row of the block, in `estimates` (overwritten).
  void run(const recording::SampleBlock& block, std::vector<sensor::Estimate<double>>& estimates);

 private:
  model::RunningSensor sensor_;
};

/// Names of the set bits, joined by '|'; empty when all is well. Each combination is put together once.
class StatusText {
 public:
  [[nodiscard]] std::string_view operator()(sensor::Status status);

 private:
  std::vector<std::pair<sensor::Status, std::string>> known_;
};

}  // namespace spoolflow::validation
