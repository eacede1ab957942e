#pragma once
#include <stdexcept>
#include <string>

namespace spoolflow::model {

/// A model file that cannot be used. The message names the file, the JSON path, the value, what is allowed and what to
/// do. Derives from std::invalid_argument: the command ends with exit status 2.
struct ModelError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

}  // namespace spoolflow::model
