#pragma once
#include <stdexcept>
#include <string>

namespace spoolflow::calibration {

/// Recordings that cannot support a map. The message names the recording, the level and direction or positions that are
/// missing, and what to record. Derives from std::invalid_argument: the command ends with exit status 2.
struct CalibrationError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

}  // namespace spoolflow::calibration
