#pragma once
/// What the sensor's FMU shows: inputs, outputs, and the parameters that may be tuned.
#include <string>
#include <string_view>
#include <vector>

#include "spoolflow/export/fmu/sensor_inputs.hpp"
#include "spoolflow/export/fmu/sensor_numbers.hpp"
#include "spoolflow/export/fmu/variable.hpp"
#include "spoolflow/model/parameter.hpp"
#include "spoolflow/sensor/condensed.hpp"
#include "spoolflow/sensor/observer.hpp"

namespace spoolflow::exports::fmu {

/// How an FMU shows a number of the model that it lets its user tune.
struct Tunable {
  std::string_view key;  ///< as in the model file
  std::string_view name;
  std::string_view display_unit;
};

/// In the order of the description; numbers that this estimator does not have are not among them.
struct TunableNumber {
  std::string name;  ///< as shown; of a whole valve behind "b." or "a.", the direction
  Tunable shown;
  model::Parameter about;
  double* value;  ///< inside the parameters
};
/// Of either estimator, of one direction or of both.
template <class Parameters>
[[nodiscard]] std::vector<TunableNumber> tunable_numbers(Parameters& parameters);

/// Scales of one valve, for nominal values.
struct SensorScale {
  double rated_flow_m3_per_s;
  double stroke_m;
  bool whole = false;  ///< both directions
};

/// All variables; start values of the tunable ones are the model's.
[[nodiscard]] std::vector<Variable> sensor_variables(const SensorScale& scale,
                                                     const std::vector<TunableNumber>& tunable);

}  // namespace spoolflow::exports::fmu
