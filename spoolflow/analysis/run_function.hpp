#pragma once
/// The measurement function along a run: from the errors of all inputs to the flow rate at every watched instant, by
/// the sensor's own code.
#include "spoolflow/analysis/run_samples.hpp"
#include "spoolflow/estimation/estimator.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/uncertainty/condensed_slopes.hpp"
#include "spoolflow/uncertainty/operating_point.hpp"
#include "spoolflow/uncertainty/pressure_belief.hpp"
#include "spoolflow/uncertainty/seeded_numbers.hpp"

namespace spoolflow::analysis {

/// Flow rates with the sensor's own band, one entry an instant [m3/s].
struct BandedFlow {
  std::vector<double> flow_m3_per_s, lower_m3_per_s, upper_m3_per_s;
  /// The answer, all of it moved by `shift_m3_per_s`.
  void add(const sensor::Estimate<double>& answer, double shift_m3_per_s = 0);
};

/// Keeps references to model and run.
class RunFunction {
 public:
  RunFunction(const model::Model& model, estimation::Estimator estimator, const RunSamples& run);

  /// At the instants. The noises' entries are standard deviations, every sample has its own error; the pressure
  /// estimate's is a standard normal number.
  [[nodiscard]] BandedFlow operator()(const uncertainty::InputErrors<double>& error,
                                      uncertainty::SeededNumbers& noise) const;
  /// Derivatives at the instants, condensed sensor only.
  [[nodiscard]] std::vector<uncertainty::PerQuantity<double>> slopes() const;

  /// As the sensor answers, at the instants.
  [[nodiscard]] const BandedFlow& undisturbed() const { return undisturbed_; }
  /// The flow as a meter with that lag would show it.
  [[nodiscard]] std::vector<double> lagged_m3_per_s(double lag_s) const;
  /// What the observer leaves open of the flow rate by its estimate of the pressure difference.
  [[nodiscard]] std::vector<double> belief_m3_per_s() const;
  /// Observer only, at the instants.
  [[nodiscard]] const std::vector<uncertainty::PressureBelief>& beliefs() const { return beliefs_; }

  [[nodiscard]] estimation::Estimator estimator() const { return estimator_; }

 private:
  void run_undisturbed();
  void learn_surroundings();
  [[nodiscard]] BandedFlow condensed(const uncertainty::InputErrors<double>& error,
                                     uncertainty::SeededNumbers& noise) const;
  [[nodiscard]] BandedFlow observer(const uncertainty::InputErrors<double>& error,
                                    uncertainty::SeededNumbers& noise) const;

  const model::Model& model_;
  estimation::Estimator estimator_;
  const RunSamples& run_;
  std::vector<double> every_flow_m3_per_s_;  ///< of all samples
  BandedFlow undisturbed_;                   ///< at the instants, as all below
  std::vector<double> pressure_Pa_;
  std::vector<uncertainty::PressureBelief> beliefs_;     ///< observer
  std::vector<uncertainty::Surroundings> surroundings_;  ///< condensed
  double temperature_per_viscosity_K_;
};

}  // namespace spoolflow::analysis
