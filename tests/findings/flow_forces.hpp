#pragma once
/// Flow force over flow, opening and oil temperature, as an external drive would measure it without friction (paper
/// section 2.1 and Fig 5).
#include <vector>

#include "tests/findings/finding.hpp"

namespace spoolflow::findings {

/// At one position and temperature, over growing pressure difference.
struct FlowForceCurve {
  double position_mm = 0;
  double temperature_C = 0;
  std::vector<double> pressure_bar{}, flow_L_min{}, force_N{};

  /// Flow force [N] at a flow, interpolated; NaN outside.
  [[nodiscard]] double force_at(double flow) const;
};

[[nodiscard]] std::vector<FlowForceCurve> flow_force_curves(double temperature_C);

struct TemperatureEffect {
  double position_mm = 0, flow_L_min = 0;
  std::vector<double> temperature_C{}, force_N{};
  [[nodiscard]] double fall_percent() const { return 100 * (1 - force_N.back() / force_N.front()); }
};
/// At constant flow (from an eighth of full scale on) and position from 30 to 80 C, where 5 to 70 bar drive that flow.
[[nodiscard]] std::vector<TemperatureEffect> temperature_effects();

[[nodiscard]] std::vector<Finding> flow_force_findings(const std::vector<FlowForceCurve>& curves,
                                                       const std::vector<TemperatureEffect>& effects);

}  // namespace spoolflow::findings
