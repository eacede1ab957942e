#pragma once
/// How the position controller hunts while the spool rests (paper section 4): it pushes until the spool breaks away,
/// overshoots, and sticks on the other side.
#include <vector>

#include "tests/findings/finding.hpp"

namespace spoolflow::findings {

/// One rest of 15 s at 60 bar.
struct Rest {
  double flow_L_min;     ///< mean
  double force_swing_N;  ///< of the magnetic force, peak to peak
  double position_swing_um;
  std::vector<double> time_s, force_N, position_um;  ///< from the start of the rest; position about its set value
};

/// Rests from 15 to 95 % of the stroke, once for each of three seeds of noise.
[[nodiscard]] std::vector<Rest> rests();
[[nodiscard]] std::vector<Finding> hunting_findings(const std::vector<Rest>& rests);

}  // namespace spoolflow::findings
