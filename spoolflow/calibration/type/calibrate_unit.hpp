#pragma once
/// From a type's model and a minute of a unit's recordings to the unit's own model.
#include <string>
#include <utility>
#include <vector>

#include "spoolflow/calibration/calibrate.hpp"
#include "spoolflow/calibration/numerics/calibration_error.hpp"
#include "spoolflow/calibration/type/map_estimate.hpp"
#include "spoolflow/calibration/type/unit_evidence.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/recording/campaign.hpp"

namespace spoolflow::calibration {

/// More standard deviations than that between a unit and its type in one direction, and it is not of the type; ...
inline constexpr double foreign_deviations = 4.5;
/// ... more than that, and it is marked as at the type's edge.
inline constexpr double marginal_deviations = 3;
/// Sum of the squares of all directions' standard deviations that no unit of the type reaches: chi square of sixteen
/// directions, one unit in a thousand; what is not seen adds nothing to it.
inline constexpr double foreign_chi_square = 39;
/// Recordings fit no unit where their rows are off by more than this times what was expected.
inline constexpr double largest_misfit = 4;
/// A direction whose uncertainty stays above this share of its tolerance was not seen by the recordings.
inline constexpr double unseen_share = 0.8;

/// How far a unit lies from its type in one direction.
struct UnitParameter {
  std::string name, unit;
  double tolerance, value, uncertainty;
  double deviations;  ///< from the type's mean, in standard deviations between its units
  bool seen, marginal;
};

struct UnitCalibration {
  model::Model model;
  std::vector<UnitParameter> parameters;
  double chi_square;
  double misfit;  ///< see UnitFit
  KnownDeviations known;
  std::string refusal;  ///< why it is not of the type; empty: it is
};

/// A unit that is not of its type, with what its recordings say nonetheless; its `model` is the type's under the unit's
/// name.
struct ForeignUnit : CalibrationError {
  explicit ForeignUnit(UnitCalibration foreign) : CalibrationError(foreign.refusal), unit(std::move(foreign)) {}
  UnitCalibration unit;
};

/// The name of a unit's protocol in provenance that stands for its type's model.
inline constexpr const char* type_protocol = "type";

/// A unit's recordings in memory.
struct UnitRecordings {
  std::string name;  ///< the unit's, as its model has it
  std::string file;  ///< what messages name
  std::vector<UnitRun> runs;
};

/// Fits them. The model keeps the type's provenance. Throws CalibrationError: recordings that show nothing of any
/// direction; ForeignUnit: it is not of the type, with the directions by name and by how many standard deviations.
[[nodiscard]] UnitCalibration unit_of_type(const model::Model& type, const std::string& type_file,
                                           const UnitRecordings& unit);

/// Reads the unit's recordings and does the same, with a provenance of its own. `type_file` is the file of `type`, for
/// provenance and messages. Throws RecordingError or CalibrationError for recordings that cannot serve.
[[nodiscard]] UnitCalibration calibrate_unit(const model::Model& type, const std::string& type_file,
                                             const recording::Campaign& unit, const std::string& tool_version,
                                             const CalibrationProgress& progress);

/// The valve of a type as a unit's campaign takes it.
[[nodiscard]] recording::CampaignValve valve_of_type(const model::Model& type);

}  // namespace spoolflow::calibration
