#pragma once
#include <stdexcept>
#include <string>
#include <vector>

namespace spoolflow::calibration {

/// Recordings that cannot support a map. The message names the recording, the level and direction or positions that are
/// missing, and what to record. Derives from std::invalid_argument: the command ends with exit status 2.
struct CalibrationError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// A refusal, and what speaks against the recordings that led to it.
[[nodiscard]] inline std::string with_doubts(std::string refusal, const std::vector<std::string>& doubts) {
  for (const std::string& doubt : doubts)
    refusal += (&doubt == &doubts.front() ? "; likely the recordings are wrong: " : "; ") + doubt;
  return refusal;
}

}  // namespace spoolflow::calibration
