#pragma once
/// Force hysteresis of the solenoid as its bench shows it: armature to and fro at each held current (paper, Figs 6 to
/// 8).
#include <vector>

#include "tests/findings/finding.hpp"

namespace spoolflow::findings {

/// One held current.
struct SolenoidLoop {
  double current_A = 0;
  std::vector<double> position_mm{}, force_N{};  ///< in the order of the recording: to and fro
  double mid_force_N = 0, mid_width_N = 0;       ///< mean and distance of both ways at mid stroke
};

/// The default valve's loops; `dither_percent` of the rated current, 160 Hz.
[[nodiscard]] std::vector<SolenoidLoop> solenoid_loops(double dither_percent);

/// `plain` without dither, `dithered` with it.
[[nodiscard]] std::vector<Finding> solenoid_findings(const std::vector<SolenoidLoop>& plain,
                                                     const std::vector<SolenoidLoop>& dithered);

}  // namespace spoolflow::findings
