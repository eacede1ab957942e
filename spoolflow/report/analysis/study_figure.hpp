#pragma once
#include <string>

#include "spoolflow/analysis/study.hpp"

namespace spoolflow::report {

/// Sobol indices of one output as bars with their confidence intervals: total (pale) and first order.
[[nodiscard]] std::string study_figure(const analysis::Study& study, std::size_t output);

}  // namespace spoolflow::report
