#pragma once
#include <exception>
#include <string>
#include <vector>

namespace spoolflow::apps {

/// Failures of one command that goes on after each, every one told as if it had come alone.
struct SeveralFailures : std::exception {
  std::vector<std::string> messages;
  bool of_the_work = false;  ///< one at least is no unusable input: exit status 1 instead of 2
  [[nodiscard]] const char* what() const noexcept override { return "several failures"; }
};

}  // namespace spoolflow::apps
