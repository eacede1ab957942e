#pragma once
/// The measurement function at one working point: from the errors of all inputs to the flow rate, by the sensor's own
/// code.
#include <optional>
#include <vector>

#include "spoolflow/estimation/estimator.hpp"
#include "spoolflow/uncertainty/budget.hpp"
#include "spoolflow/uncertainty/input_uncertainties.hpp"
#include "spoolflow/uncertainty/operating_point.hpp"
#include "spoolflow/uncertainty/pressure_belief.hpp"
#include "spoolflow/uncertainty/seeded_numbers.hpp"

namespace spoolflow::uncertainty {

/// Keeps a reference to the model.
class PointFunction {
 public:
  /// Nothing where the estimator's maps do not hold the point.
  static std::optional<PointFunction> at(const model::Model& model, estimation::Estimator estimator,
                                         const WorkingPoint& point);

  /// The flow rate [m3/s] with these errors. The noises' entries are one sample's error in the condensed sensor, which
  /// has no memory; in the observer they are standard deviations, and `noise` gives every sample of the course its own.
  [[nodiscard]] double operator()(const InputErrors<double>& error, SeededNumbers& noise) const;

  [[nodiscard]] estimation::Estimator estimator() const { return estimator_; }
  [[nodiscard]] const WorkingPoint& point() const { return point_; }
  /// The coil current at the point.
  [[nodiscard]] double current_A() const;
  /// The position as it is read there: the observer's with its sensor's drift.
  [[nodiscard]] double position_reading_m() const;

  /// Sensitivities and budget there. Condensed sensor: automatic differentiation through its templates. Observer, which
  /// branches on motion and surprises: central differences over plus and minus one standard uncertainty (JCGM 100,
  /// 5.1.3 note 2), noises by `noise_runs` seeded runs.
  [[nodiscard]] Budget budget(const Inputs& inputs, int noise_runs = 48) const;

 private:
  PointFunction(const model::Model& model, estimation::Estimator estimator, const WorkingPoint& point)
      : model_(&model), estimator_(estimator), point_(point) {}
  [[nodiscard]] double condensed(const InputErrors<double>& error) const;
  [[nodiscard]] double observer(const InputErrors<double>& error, SeededNumbers& noise) const;
  void learn_belief();

  const model::Model* model_;
  estimation::Estimator estimator_;
  WorkingPoint point_;
  sensor::Sample<double> sample_{};              // condensed
  Surroundings surroundings_;                    // condensed
  std::vector<estimation::TimedSample> course_;  // observer
  double temperature_per_viscosity_K_ = 0;
  PressureBelief belief_;  // observer
};

}  // namespace spoolflow::uncertainty
