#pragma once
/// The law of propagation of uncertainty (JCGM 100:2008, 5.2 and annex G).
#include <vector>

#include "spoolflow/uncertainty/input_quantity.hpp"

namespace spoolflow::uncertainty {

/// One input's part in the uncertainty of the flow rate.
struct BudgetLine {
  InputUncertainty input;
  double sensitivity_m3_per_s = 0;   ///< flow per SI unit of the quantity
  double contribution_m3_per_s = 0;  ///< sensitivity times standard uncertainty, with its sign
  double share = 0;                  ///< of the variance, correlations included: all add up to one
  double degrees_of_freedom = 0;     ///< of the contribution
};

struct Budget {
  std::vector<BudgetLine> lines;
  std::vector<Correlation> correlations;
  double combined_m3_per_s = 0;   ///< standard uncertainty
  double degrees_of_freedom = 0;  ///< effective, after Welch and Satterthwaite
  double coverage_factor = 0;     ///< of 95 %
  double expanded_m3_per_s = 0;
};

/// Combines `lines`, of which input, sensitivity, contribution and degrees of freedom are set. Inputs that are
/// correlated count in the Welch-Satterthwaite formula as one, with the fewest degrees of freedom among them, since the
/// formula holds for independent contributions only (JCGM 100, G.4.1).
[[nodiscard]] Budget combine(std::vector<BudgetLine> lines, std::vector<Correlation> correlations);

}  // namespace spoolflow::uncertainty
