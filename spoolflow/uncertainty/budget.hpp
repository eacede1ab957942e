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

/// After Welch and Satterthwaite, from the lines' shares. Inputs that are correlated count as one, with the fewest
/// degrees of freedom among those that contribute, since the formula holds for independent contributions only
/// (JCGM 100, G.4.1). Infinite where no line has few.
[[nodiscard]] double effective_degrees_of_freedom(const std::vector<BudgetLine>& lines,
                                                  const std::vector<Correlation>& correlations);

/// Combines `lines`, of which input, sensitivity, contribution and degrees of freedom are set.
[[nodiscard]] Budget combine(std::vector<BudgetLine> lines, std::vector<Correlation> correlations);

}  // namespace spoolflow::uncertainty
