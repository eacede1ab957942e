#pragma once
#include <cstdint>

#include "spoolflow/analysis/sobol_indices.hpp"

namespace spoolflow::analysis {

/// The test function of Ishigami and Homma (1990), whose indices are known in closed form:
/// y = sin x1 + 7 sin^2 x2 + 0.1 x3^4 sin x1, each x uniform over -pi to pi.
[[nodiscard]] double ishigami(const std::vector<double>& uniform);

/// What the program's own sampling and estimators find, beside what is known.
struct SelfCheck {
  std::uint32_t base_samples;
  std::uint64_t seed;
  SobolIndices found;
  std::vector<double> first_order, total;  ///< in closed form
  bool passed;                             ///< every known index lies in the interval found
};
[[nodiscard]] SelfCheck check_ishigami(std::uint32_t base_samples, std::uint64_t seed);

}  // namespace spoolflow::analysis
