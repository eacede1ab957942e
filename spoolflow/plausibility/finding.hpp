#pragma once
#include <string>

namespace spoolflow::plausibility {

/// What physics says against a recording.
struct Finding {
  bool cannot_be;    ///< and not only unusual
  std::string text;  ///< one sentence: file, channel, likely cause, the figure that shows it
};

}  // namespace spoolflow::plausibility
