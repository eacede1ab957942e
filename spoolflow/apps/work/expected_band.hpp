#pragma once
/// How wide a sensor's band will be, before anything is recorded.
#include "spoolflow/model/model.hpp"

namespace spoolflow::apps {

/// Half the width of the full sensor's 95 % band [share of the rated flow], mean over openings, pressure differences
/// and both ways of a spool that slides, from samples that the model itself would show. NaN where no point of the maps
/// can be reached. Keep out: models without the full sensor and of whole valves.
[[nodiscard]] double expected_half_width(const model::Model& model);

}  // namespace spoolflow::apps
