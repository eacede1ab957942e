#pragma once
/// What raised indicators say against the model, as a wider band about the sensor's answer.
#include "spoolflow/estimation/running_sensor.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/monitor/fault_parameters.hpp"

namespace spoolflow::monitor {

/// The likeliest explanation of one side; nothing where no chart is raised.
struct DirectionDoubt {
  bool raised = false;
  Magnitudes value{};  ///< in usual_fault
};
struct Doubt {
  std::array<DirectionDoubt, 2> side{};  ///< of solenoids b and a
  [[nodiscard]] bool any() const { return side[0].raised || side[1].raised; }
};

/// The answer with its band widened to both sides by what the explanation makes of the flow rate: its force as an error
/// of the pressure difference, friction's by its size whichever its sign, and the opening that rounded edges or a
/// shifted position add, and with `model_doubt` in its status. The estimate itself stays; without doubt all does.
/// `oil_temperature_K`: smoothed.
[[nodiscard]] sensor::Estimate<double> widened(const model::Model& model, const Doubt& doubt,
                                               const estimation::TimedSample& sample, double oil_temperature_K,
                                               const sensor::Estimate<double>& answer);

}  // namespace spoolflow::monitor
