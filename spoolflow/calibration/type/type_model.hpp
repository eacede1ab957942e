#pragma once
/// A model that serves every unit of a type, with the spread that manufacturing leaves between them.
#include <string>
#include <vector>

#include "spoolflow/calibration/type/map_estimate.hpp"
#include "spoolflow/calibration/type/variation.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/recording/campaign.hpp"

namespace spoolflow::calibration {

/// One standard deviation between units for every direction: what all_variations() says, or [tolerances] of the
/// campaign, where lengths are in micrometres: `edge_position_um`, `position_zero_um`. Throws CalibrationError with the
/// line where a key is none of them or a value is beyond what unit_parameters() is for.
[[nodiscard]] Deviations tolerances_from(const recording::CampaignTolerances& written);

/// The same of the first campaign that has [tolerances]. Throws CalibrationError where another's differ.
[[nodiscard]] Deviations tolerances_of(const std::vector<recording::Campaign>& campaigns);

/// A valve's own model as that of its type: the tables stay, the band holds units within these tolerances; of a whole
/// valve each direction by itself. Throws CalibrationError where the model has no observer, or is of a type or a unit
/// already.
[[nodiscard]] model::Model type_model(model::Model valve, const Deviations& tolerances);
/// The same of one direction where `units` says how the next unit lies about the tables, and `tolerances` its standard
/// deviations.
[[nodiscard]] model::Model type_model(model::Model valve, const Deviations& tolerances, const KnownDeviations& units);

/// What a type's model says of its units. Throws CalibrationError where `model`, from `file`, is no type's, or lacks a
/// direction of all_variations() or has another.
[[nodiscard]] KnownDeviations known_of_type(const model::Model& model, const std::string& file);

/// The section of a unit's model, or of its type's where `unit` is false.
[[nodiscard]] model::TypeSection type_section(const std::string& type_name, bool unit, const Deviations& tolerances,
                                              const KnownDeviations& known,
                                              const model::EnvironmentWithoutSpread& environment);

/// Puts `environment` into the observer, and what `known` leaves open of the unit's forces, friction and flow beside
/// it, as root of the sum of squares.
void set_spread(model::Model& model, const model::EnvironmentWithoutSpread& environment, const KnownDeviations& known);

}  // namespace spoolflow::calibration
