#pragma once
#include "spoolflow/model/model.hpp"
#include "spoolflow/monitor/fault_parameters.hpp"

namespace spoolflow::monitor {

/// One standard deviation of a healthy valve against `model`, in usual faults: `healthy_spread`, and beside it, of a
/// type's model, by how much its units differ; of a unit's, what its recordings left open. Deviations count by the
/// magnitude whose signature is nearest to theirs. Omits what the unknown pressure difference takes up, as the edge's
/// width and the flow force at a given flow, and the width of the magnetic loop, which is small beside friction.
[[nodiscard]] Magnitudes healthy_spread_of(const model::Model& model);

}  // namespace spoolflow::monitor
