#pragma once
#include "spoolflow/model/model.hpp"

namespace spoolflow::monitor {

/// What `calibrate` makes of the example recordings.
inline const model::Model& example() {
  static const model::Model model = model::read_model(SPOOLFLOW_EXAMPLE_MODEL);
  return model;
}

}  // namespace spoolflow::monitor
