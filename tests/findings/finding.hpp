#pragma once
/// One figure that must come out of the rig, measured on it, beside what the paper says.
#include <string>

namespace spoolflow::findings {

struct Finding {
  std::string what;
  double value;
  std::string unit;
  double lowest, highest;  ///< wanted
  std::string from;        ///< paper section

  [[nodiscard]] bool holds() const { return value >= lowest && value <= highest; }
};

}  // namespace spoolflow::findings
