#include "spoolflow/estimation/estimator.hpp"

namespace spoolflow::estimation {
namespace {

RunningSensor::Parameters parameters_of(const model::Model& model, Estimator estimator) {
  if (estimator == Estimator::condensed) return &model.condensed.parameters;
  if (!model.observer) {
    throw model::ModelError("the model of " + model.valve.name +
                            " is not calibrated for the observer; calibrate it again with this program, or use "
                            "--estimator condensed");
  }
  return &model.observer->parameters;
}

}  // namespace

std::string_view name(Estimator estimator) {
  return estimator == Estimator::condensed ? "condensed" : "observer";
}

Estimator best_estimator(const model::Model& model) {
  return model.observer ? Estimator::observer : Estimator::condensed;
}

std::vector<Estimator> all_estimators(const model::Model& model) {
  if (!model.observer) return {Estimator::condensed};
  return {Estimator::condensed, Estimator::observer};
}

RunningSensor running_sensor(const model::Model& model, Estimator estimator) {
  return {parameters_of(model, estimator), model.valve.rated_flow_m3_per_s};
}

}  // namespace spoolflow::estimation
