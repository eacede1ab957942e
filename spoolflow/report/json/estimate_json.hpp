#pragma once
#include <iosfwd>
#include <vector>

#include "spoolflow/validation/estimate_summary.hpp"

namespace spoolflow::report {

/// Of each recording: samples, mean flow and width of the band [L/min], share of samples with each status (0 to 1),
/// what was met while reading, doubts.
void write_estimate_summary(std::ostream& out, const std::vector<validation::EstimateSummary>& summaries);

}  // namespace spoolflow::report
