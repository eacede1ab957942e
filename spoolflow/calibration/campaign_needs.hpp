#pragma once
/// What recordings of a valve suffice for, and which ones are missing, in minutes of bench time.
#include <string>
#include <string_view>
#include <vector>

#include "spoolflow/recording/campaign.hpp"
#include "spoolflow/recording/recording.hpp"

namespace spoolflow::calibration {

/// What of a recording counts here.
struct Recorded {
  recording::Protocol protocol;
  std::string direction = "b";
  double oil_temperature_K = 0;  ///< mean; NaN where it was not recorded
  int levels = 0;                ///< held pressure differences with a whole slow stroke at each
  bool voltage = false;          ///< of the coil
};

/// Which protocol the recording was made by, from its channels and its course, and what of it counts. Strokes count as
/// slow from 4 s a stroke on. Throws CalibrationError where it serves none: it lacks position, or current and force.
[[nodiscard]] Recorded recognised(const recording::Recording& recording);
/// The same of a recording whose protocol is known.
[[nodiscard]] Recorded recorded_by(const recording::Recording& recording, recording::Protocol protocol);

/// A recording that is missing.
struct NeededRecording {
  recording::Protocol protocol;
  std::string direction;
  std::string why;  ///< what it shows, or what the recording that is there lacks
  double minutes;   ///< on the bench, without rebuilding it or warming the oil
};

/// A kind of model: "force benches", "flow bench", "unit of a type".
struct ModelNeeds {
  std::string_view kind;
  std::vector<NeededRecording> missing;  ///< none: `calibrate` makes it
  std::vector<NeededRecording> better;   ///< without which more stays assumed
  [[nodiscard]] double missing_minutes() const;
};

/// Of all kinds, in that order; of each direction that was recorded, of "b" where none was.
[[nodiscard]] std::vector<ModelNeeds> needs_of(const std::vector<Recorded>& recorded);

}  // namespace spoolflow::calibration
