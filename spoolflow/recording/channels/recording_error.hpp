#pragma once
#include <stdexcept>
#include <string>

namespace spoolflow::recording {

/// Input that cannot be used. The message names file, line or channel, the value, what is allowed and what to do next.
/// Derives from std::invalid_argument: the command ends with exit status 2.
struct RecordingError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

}  // namespace spoolflow::recording
