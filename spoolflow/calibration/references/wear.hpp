#pragma once
/// What wear and drift change of a valve's model, and the model so changed.
#include <string>
#include <vector>

#include "spoolflow/calibration/type/unit_parameters.hpp"
#include "spoolflow/model/model.hpp"

namespace spoolflow::calibration {

/// The observer's parameters with other edges, friction in operation and position zero; a relative change of a relative
/// change is one of their product and sum. `edge_width` and `friction_ratio` count against those of `valve`.
[[nodiscard]] sensor::ObserverParameters<double> worn(const sensor::ObserverParameters<double>& valve,
                                                      const model::WearState& wear);
[[nodiscard]] sensor::CondensedParameters<double> worn(const sensor::CondensedParameters<double>& valve,
                                                       const model::WearState& wear);

/// The state of which references have last written into the model of one direction; none: as calibrated.
[[nodiscard]] model::WearState wear_of(const model::Model& model);
/// All of them, oldest first: the first is as calibrated. Of a whole valve those of both directions in the log's order.
[[nodiscard]] std::vector<model::WearState> wear_states(const model::Model& model);

/// What `monitor --adapt` corrected of the model, in words: no wear state undoes it.
[[nodiscard]] std::vector<std::string> corrected_in_all_states(const model::Model& model);

/// The model of one direction as it is with `to` instead of wear_of(model), and its band; the log stays as it is.
[[nodiscard]] model::Model moved(const model::Model& model, const model::WearState& to);

}  // namespace spoolflow::calibration
