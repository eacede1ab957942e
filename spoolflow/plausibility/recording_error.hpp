#pragma once
/// The usual recording errors between an instrument and a file: a sign, a unit, a power of ten, a position counted from
/// the wrong end.
#include <span>
#include <string_view>

#include "spoolflow/recording/channels/channel.hpp"

namespace spoolflow::plausibility {

struct RecordingError {
  std::string_view looks;       ///< "in kgf, not N"
  std::string_view undo;        ///< "times 9.80665"
  double factor;                ///< on the value, to undo it
  bool from_other_end = false;  ///< the position, before the factor, is the stroke less the value

  [[nodiscard]] double undone(double value, double stroke_m) const {
    return factor * (from_other_end ? stroke_m - value : value);
  }
};

/// What is tried of a channel, the commonest first; empty for channels that no check reads.
[[nodiscard]] std::span<const RecordingError> usual_recording_errors(recording::Channel channel);

/// Of a rated flow.
[[nodiscard]] std::span<const RecordingError> usual_errors_of_rated_flow();

}  // namespace spoolflow::plausibility
