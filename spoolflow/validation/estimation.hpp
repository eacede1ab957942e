#pragma once
/// Runs a model's sensor over a recording, block by block, as the valve would: one sample after the other.
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "spoolflow/model/model.hpp"
#include "spoolflow/recording/reader.hpp"
#include "spoolflow/sensor/condensed.hpp"
#include "spoolflow/sensor/observer.hpp"

namespace spoolflow::validation {

enum class Estimator { condensed, observer };
[[nodiscard]] std::string_view name(Estimator estimator);
/// The observer where the model has one.
[[nodiscard]] Estimator best_estimator(const model::Model& model);

/// What the sensor reads of a recording, and nothing else: time, current, position; voltage and oil temperature where
/// they are.
[[nodiscard]] recording::ReadOptions sensor_channels(const model::Model& model, recording::ChannelMap channels);

/// One sensor in operation. Before the first complete sample its flow is zero with a band over the whole rated flow.
class Estimation {
 public:
  /// Keeps a reference to the model. Throws ModelError where the model is not calibrated for the estimator.
  Estimation(const model::Model& model, Estimator estimator);
  /// One estimate a row of the block, in `estimates` (overwritten).
  void run(const recording::SampleBlock& block, std::vector<sensor::Estimate<double>>& estimates);

 private:
  template <class Parameters, class State>
  void run_with(const Parameters& parameters, State& state, const recording::SampleBlock& block,
                std::vector<sensor::Estimate<double>>& estimates);

  const model::Model& model_;
  std::variant<sensor::CondensedState<double>, sensor::ObserverState<double>> state_;
  double last_time_s_ = 0;
  bool started_ = false;
  bool answered_ = false;
};

/// Names of the set bits, joined by '|'; empty when all is well. Each combination is put together once.
class StatusText {
 public:
  [[nodiscard]] std::string_view operator()(sensor::Status status);

 private:
  std::vector<std::pair<sensor::Status, std::string>> known_;
};

}  // namespace spoolflow::validation
