#pragma once
/// From a valve's model, recordings of its operation and what the machine knows of its oil to the model as it is.
///
///     RecalibratedValve out = recalibrate(model, recordings, references, how);
#include <string>
#include <vector>

#include "spoolflow/calibration/references/wear_search.hpp"

namespace spoolflow::calibration {

/// No more is moved, against the model as it was calibrated: beyond, the valve is to be repaired or calibrated again.
inline constexpr double most_edge_width = 0.35, most_friction_ratio = 3, most_position_zero_m = 60e-6;

struct RecalibratedValve {
  model::Model model;
  std::vector<std::string> findings;  ///< sentences: what was changed, left out, or stays, and why
  std::vector<std::string> doubts;    ///< of them those by which a reference may be misstated
};

/// Whether references move that model. Throws CalibrationError where it is of a type, or without an observer.
void require_movable(const model::Model& model);

/// The model moved on: position zero, friction in operation and the edges' width, each where the evidence pays for it,
/// else as it was to the last bit. Of a whole valve each direction is moved by the references that are of it, and the
/// position zero stays, which its sensor finds at rest. `how` has tool, time and the model file's checksum; the rest is
/// filled in and put at the end of the provenance, an entry a direction. Throws RecordingError or CalibrationError: a
/// model that is not movable; a reference of a recording that is not given, or view_of_direction() cannot place;
/// references that contradict forces or each other, with the likely cause; a change beyond what is moved.
[[nodiscard]] RecalibratedValve recalibrate(const model::Model& model,
                                            const std::vector<recording::Recording>& recordings,
                                            const std::vector<recording::Reference>& references, model::Adaptation how);

/// The model as it was in an earlier state, 0 for as calibrated: wear_states(). A whole valve's directions go back
/// together. The log goes on. Throws CalibrationError where there is no such state.
[[nodiscard]] RecalibratedValve gone_back(const model::Model& model, std::size_t state, model::Adaptation how);

}  // namespace spoolflow::calibration
