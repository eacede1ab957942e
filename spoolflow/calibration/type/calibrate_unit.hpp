#pragma once
/// From a type's model and a minute of a unit's recordings to the unit's own model.
#include <filesystem>
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

/// One direction of flow of it.
struct UnitCalibration {
  model::Model model;  ///< of that direction
  std::vector<UnitParameter> parameters;
  double chi_square;
  double misfit;  ///< see UnitFit
  KnownDeviations known;
  std::string refusal;                          ///< why it is not of the type; empty: it is
  std::vector<std::filesystem::path> shown_by;  ///< the recordings that show its forces or flow
};

struct CalibratedUnit {
  model::Model model;
  std::vector<UnitCalibration> directions;  ///< in the order of model::directions(); of no refusal
};

/// A unit that is not of its type, with what its recordings say nonetheless; a direction's `model` is the type's under
/// the unit's name where that is refused.
struct ForeignUnit : CalibrationError {
  ForeignUnit(const std::string& refusal, std::vector<UnitCalibration> foreign)
      : CalibrationError(refusal), directions(std::move(foreign)) {}
  std::vector<UnitCalibration> directions;
};

/// The name of a unit's protocol in provenance that stands for its type's model.
inline constexpr const char* type_protocol = "type";

/// A unit's recordings in memory.
struct UnitRecordings {
  std::string name;  ///< the unit's, as its model has it
  std::string file;  ///< what messages name
  std::vector<UnitRun> runs;
};

/// Fits them, of a whole valve each direction by itself from its runs and its part of those through the centre; one of
/// which there is none stays the type's. The model keeps the type's provenance. Throws CalibrationError: recordings
/// that show nothing; ForeignUnit: it is not of the type, with the directions of variation by name and by how many
/// standard deviations.
[[nodiscard]] CalibratedUnit unit_of_type(const model::Model& type, const std::string& type_file,
                                          const UnitRecordings& unit);

/// Reads the unit's recordings and does the same, with a provenance of its own. `type_file` is the file of `type`, for
/// provenance and messages. Throws RecordingError or CalibrationError for recordings that cannot serve.
[[nodiscard]] CalibratedUnit calibrate_unit(const model::Model& type, const std::string& type_file,
                                            const recording::Campaign& unit, const std::string& tool_version,
                                            const CalibrationProgress& progress);

/// The valve of a type as a unit's campaign takes it.
[[nodiscard]] recording::CampaignValve valve_of_type(const model::Model& type);

}  // namespace spoolflow::calibration
