#pragma once
/// What a machine's recordings and references show of one direction of its valve.
#include <deque>
#include <string>
#include <vector>

#include "spoolflow/model/model.hpp"
#include "spoolflow/recording/recording.hpp"
#include "spoolflow/recording/references.hpp"

namespace spoolflow::calibration {

/// Of a whole valve each recording as its direction alone would show it, positions from where the spool rests in the
/// centre, flow >= 0. Of a valve of one direction all is as it was given.
struct DirectionView {
  std::string direction;
  std::vector<const recording::Recording*> recordings;
  std::vector<recording::Reference> references;  ///< those that are of it
  std::vector<std::vector<bool>> other_opens;    ///< of each, in which samples the spool opens the other; empty: none
  std::deque<recording::Recording> made;         ///< of a whole valve, for `recordings`
};

/// `direction` is one of model::directions(). Throws CalibrationError: a reference of a whole valve that does not say
/// its direction, or sees ends by the sensor; one of another direction than the model's; a recording without rest in
/// the centre.
[[nodiscard]] DirectionView view_of_direction(const model::Model& model, const std::string& direction,
                                              const std::vector<recording::Recording>& recordings,
                                              const std::vector<recording::Reference>& references);

}  // namespace spoolflow::calibration
