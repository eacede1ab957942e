#pragma once
#include <string>

namespace spoolflow::consistency {

/// What physics says against a recording.
struct Doubt {
  bool cannot_be;    ///< and not only unusual
  std::string text;  ///< one sentence: file, channel, likely cause, what tells it
};

}  // namespace spoolflow::consistency
