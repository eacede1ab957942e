#pragma once
/// The sensors that a model can run.
#include <string_view>
#include <vector>

#include "spoolflow/estimation/running_sensor.hpp"
#include "spoolflow/model/model.hpp"

namespace spoolflow::estimation {

enum class Estimator { condensed, observer };
[[nodiscard]] std::string_view name(Estimator estimator);

/// The observer where the model has one.
[[nodiscard]] Estimator best_estimator(const model::Model& model);

/// Both where the model has both.
[[nodiscard]] std::vector<Estimator> all_estimators(const model::Model& model);

/// A sensor as new. Keeps a reference to the model. Throws ModelError where the model is not calibrated for the
/// estimator.
[[nodiscard]] RunningSensor running_sensor(const model::Model& model, Estimator estimator);

}  // namespace spoolflow::estimation
