#pragma once
/// The measurement function along a run: from the errors of all inputs to the flow rate at every watched instant, by
/// the sensor's own code.
#include "spoolflow/analysis/run_samples.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/validation/condensed_slopes.hpp"
#include "spoolflow/validation/estimator.hpp"
#include "spoolflow/validation/operating_point.hpp"
#include "spoolflow/validation/seeded_numbers.hpp"

namespace spoolflow::analysis {

/// Keeps references to model and run.
class RunFunction {
 public:
  RunFunction(const model::Model& model, validation::Estimator estimator, const RunSamples& run);

  /// Flow rates [m3/s] at the instants. The noises' entries are standard deviations; every sample has its own error.
  [[nodiscard]] std::vector<double> operator()(const validation::InputErrors<double>& error,
                                               validation::SeededNumbers& noise) const;
  /// Derivatives at the instants, condensed sensor only.
  [[nodiscard]] std::vector<validation::PerQuantity<double>> slopes() const;

  /// Flow rate and its band as the sensor answers, at the instants.
  [[nodiscard]] const std::vector<double>& flow_m3_per_s() const { return flow_m3_per_s_; }
  [[nodiscard]] const std::vector<double>& lower_m3_per_s() const { return lower_m3_per_s_; }
  [[nodiscard]] const std::vector<double>& upper_m3_per_s() const { return upper_m3_per_s_; }
  /// The flow as a meter with that lag would show it.
  [[nodiscard]] std::vector<double> lagged_m3_per_s(double lag_s) const;
  /// What the observer's filter leaves open of the flow rate: its pressure deviation as a flow; zero of the condensed
  /// sensor.
  [[nodiscard]] const std::vector<double>& belief_m3_per_s() const { return belief_m3_per_s_; }

  [[nodiscard]] validation::Estimator estimator() const { return estimator_; }

 private:
  void run_undisturbed();
  void learn_surroundings();
  [[nodiscard]] std::vector<double> condensed(const validation::InputErrors<double>& error,
                                              validation::SeededNumbers& noise) const;
  [[nodiscard]] std::vector<double> observer(const validation::InputErrors<double>& error,
                                             validation::SeededNumbers& noise) const;

  const model::Model& model_;
  validation::Estimator estimator_;
  const RunSamples& run_;
  std::vector<double> every_flow_m3_per_s_;  ///< of all samples
  std::vector<double> flow_m3_per_s_, lower_m3_per_s_, upper_m3_per_s_, pressure_Pa_, belief_m3_per_s_;
  std::vector<validation::Surroundings> surroundings_;  ///< condensed, at the instants
  double temperature_per_viscosity_K_;
};

}  // namespace spoolflow::analysis
