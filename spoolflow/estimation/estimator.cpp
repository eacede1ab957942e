#include "spoolflow/estimation/estimator.hpp"

namespace spoolflow::estimation {
namespace {

RunningSensor::Parameters parameters_of(const model::Model& model, Estimator estimator) {
  if (estimator == Estimator::condensed) {
    if (!model.whole()) return &model.condensed.parameters;
    return RunningSensor::WholeCondensed{&model.condensed.parameters, &model.p_to_a->condensed.parameters};
  }
  if (!model.has_observer()) {
    throw model::ModelError("the model of " + model.valve.name +
                            " is not calibrated for the observer; calibrate it again with this program, or use "
                            "--estimator condensed");
  }
  if (!model.whole()) return &model.observer->parameters;
  return sensor::WholeValveParameters<double>{&model.observer->parameters, &model.p_to_a->observer->parameters};
}

}  // namespace

std::string_view name(Estimator estimator) {
  return estimator == Estimator::condensed ? "condensed" : "observer";
}

Estimator best_estimator(const model::Model& model) {
  return model.has_observer() ? Estimator::observer : Estimator::condensed;
}

std::vector<Estimator> all_estimators(const model::Model& model) {
  if (!model.has_observer()) return {Estimator::condensed};
  return {Estimator::condensed, Estimator::observer};
}

RunningSensor running_sensor(const model::Model& model, Estimator estimator) {
  return {parameters_of(model, estimator), model.valve.rated_flow_m3_per_s};
}

}  // namespace spoolflow::estimation
